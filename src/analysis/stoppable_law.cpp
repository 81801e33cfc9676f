// SPDX-License-Identifier: GPL-3.0-or-later
// Contact laws and indenter profiles that throw Interrupted when the user has asked to stop.
#include "stoppable_law.hpp"

#include <salebra/base/error.hpp>
#include <utility>

namespace salebra {
namespace {

using Stopped = std::function<bool()>;

void look(const Stopped& stopped) {
  if (stopped()) throw Interrupted("interrupted; nothing was written");
}

class StoppableLaw final : public ContactLaw {
 public:
  StoppableLaw(std::unique_ptr<const ContactLaw> law, Stopped stopped)
      : ContactLaw(law->modulus_ratio()), law_(std::move(law)), stopped_(std::move(stopped)) {}
  double force(double indentation) const override { return seen().force(indentation); }
  double normal_stiffness(double indentation) const override {
    return seen().normal_stiffness(indentation);
  }
  double force_curvature(double indentation) const override {
    return seen().force_curvature(indentation);
  }
  double tangential_stiffness(double indentation) const override {
    return seen().tangential_stiffness(indentation);
  }
  double tangential_curvature(double indentation) const override {
    return seen().tangential_curvature(indentation);
  }
  double stiffness_ratio(double indentation) const override {
    return seen().stiffness_ratio(indentation);
  }
  double first_touch() const override { return law_->first_touch(); }
  double lowest_indentation() const override { return law_->lowest_indentation(); }
  double highest_indentation() const override { return law_->highest_indentation(); }
  double indentation_of(double force) const override { return seen().indentation_of(force); }
  std::vector<double> break_points() const override { return law_->break_points(); }
  std::unique_ptr<const ContactLaw> coarser(bool odd) const override {
    auto law = law_->coarser(odd);
    return law ? std::make_unique<StoppableLaw>(std::move(law), stopped_) : nullptr;
  }

 private:
  const ContactLaw& seen() const {
    look(stopped_);
    return *law_;
  }
  std::unique_ptr<const ContactLaw> law_;
  Stopped stopped_;
};

class StoppableProfile final : public IndenterProfile {
 public:
  StoppableProfile(std::shared_ptr<const IndenterProfile> profile, Stopped stopped)
      : profile_(std::move(profile)), stopped_(std::move(stopped)) {}
  double height(double r) const override { return seen().height(r); }
  double image(double x) const override { return seen().image(x); }
  double image_slope(double x) const override { return seen().image_slope(x); }
  double image_integral(double x) const override { return seen().image_integral(x); }
  double flat_radius() const override { return profile_->flat_radius(); }
  double max_radius() const override { return profile_->max_radius(); }
  bool has_side() const override { return profile_->has_side(); }
  std::vector<double> breaks() const override { return profile_->breaks(); }
  double contact_radius(double indentation) const override {
    return seen().contact_radius(indentation);
  }

 private:
  const IndenterProfile& seen() const {
    look(stopped_);
    return *profile_;
  }
  std::shared_ptr<const IndenterProfile> profile_;
  Stopped stopped_;
};

}  // namespace

std::unique_ptr<const ContactLaw> stoppable(std::unique_ptr<const ContactLaw> law,
                                            const Context& context) {
  if (!context.stopped) return law;
  return std::make_unique<StoppableLaw>(std::move(law), context.stopped);
}

std::shared_ptr<const IndenterProfile> stoppable(std::shared_ptr<const IndenterProfile> profile,
                                                 const Context& context) {
  if (!context.stopped) return profile;
  return std::make_shared<const StoppableProfile>(std::move(profile), context.stopped);
}

}  // namespace salebra
