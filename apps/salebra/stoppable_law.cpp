// SPDX-License-Identifier: GPL-3.0-or-later
// Laws and profiles that look for signals, of stoppable_law.hpp.
#include "stoppable_law.hpp"

#include <salebra/base/error.hpp>

#include "session.hpp"

namespace salebra::cli {
namespace {

void look() {
  if (interrupted()) throw Interrupted("interrupted; nothing was written");
}

class StoppableLaw final : public ContactLaw {
 public:
  explicit StoppableLaw(std::unique_ptr<ContactLaw> law)
      : ContactLaw(law->modulus_ratio()), law_(std::move(law)) {}
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
  double lowest_indentation() const override { return law_->lowest_indentation(); }
  double highest_indentation() const override { return law_->highest_indentation(); }
  double indentation_of(double force) const override { return seen().indentation_of(force); }
  std::vector<double> break_points() const override { return law_->break_points(); }

 private:
  const ContactLaw& seen() const {
    look();
    return *law_;
  }
  std::unique_ptr<ContactLaw> law_;
};

class StoppableProfile final : public IndenterProfile {
 public:
  explicit StoppableProfile(std::shared_ptr<const IndenterProfile> profile)
      : profile_(std::move(profile)) {}
  double height(double r) const override { return seen().height(r); }
  double image(double x) const override { return seen().image(x); }
  double image_slope(double x) const override { return seen().image_slope(x); }
  double image_integral(double x) const override { return seen().image_integral(x); }
  double flat_radius() const override { return profile_->flat_radius(); }
  double largest_radius() const override { return profile_->largest_radius(); }
  bool has_side() const override { return profile_->has_side(); }
  std::vector<double> breaks() const override { return profile_->breaks(); }
  double contact_radius(double indentation) const override {
    return seen().contact_radius(indentation);
  }

 private:
  const IndenterProfile& seen() const {
    look();
    return *profile_;
  }
  std::shared_ptr<const IndenterProfile> profile_;
};

}  // namespace

std::unique_ptr<ContactLaw> stoppable(std::unique_ptr<ContactLaw> law) {
  return std::make_unique<StoppableLaw>(std::move(law));
}

std::shared_ptr<const IndenterProfile> stoppable(std::shared_ptr<const IndenterProfile> profile) {
  return std::make_shared<const StoppableProfile>(std::move(profile));
}

}  // namespace salebra::cli
