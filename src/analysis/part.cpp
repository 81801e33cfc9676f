// SPDX-License-Identifier: GPL-3.0-or-later
// Force curves and contact laws of a part, from those of its sample.
#include "part.hpp"

#include <cmath>
#include <salebra/base/error.hpp>
#include <utility>

namespace salebra {
namespace {

class LawOfPart final : public ContactLaw {
 public:
  LawOfPart(std::shared_ptr<const ContactLaw> sample, double ratio)
      : ContactLaw(sample->modulus_ratio()), sample_(std::move(sample)), ratio_(ratio) {}
  double force(double indentation) const override { return ratio_ * sample_->force(indentation); }
  double normal_stiffness(double indentation) const override {
    return ratio_ * sample_->normal_stiffness(indentation);
  }
  double force_curvature(double indentation) const override {
    return ratio_ * sample_->force_curvature(indentation);
  }
  double tangential_stiffness(double indentation) const override {
    return ratio_ * sample_->tangential_stiffness(indentation);
  }
  double tangential_curvature(double indentation) const override {
    return ratio_ * sample_->tangential_curvature(indentation);
  }
  double stiffness_ratio(double indentation) const override {
    return sample_->stiffness_ratio(indentation);
  }
  double first_touch() const override { return sample_->first_touch(); }
  double lowest_indentation() const override { return sample_->lowest_indentation(); }
  double highest_indentation() const override { return sample_->highest_indentation(); }
  double indentation_of(double force) const override {
    return sample_->indentation_of(force / ratio_);
  }
  std::vector<double> break_points() const override { return sample_->break_points(); }
  std::unique_ptr<const ContactLaw> coarser(bool odd) const override {
    std::shared_ptr<const ContactLaw> sample = sample_->coarser(odd);
    return sample ? std::make_unique<LawOfPart>(std::move(sample), ratio_) : nullptr;
  }

 private:
  std::shared_ptr<const ContactLaw> sample_;
  double ratio_;
};

}  // namespace

ForceCurve curve_of_part(ForceCurve curve, double area, const std::string& source) {
  require_positive(area, "nominal_area");
  const bool states_area = curve.nominal_area > 0;
  const double ratio = states_area ? area / curve.nominal_area : 1;
  for (ForceSample& sample : curve.samples) {
    if (!states_area) {
      require_that(std::isnan(sample.force) && std::isnan(sample.normal_stiffness) &&
                       std::isnan(sample.tangential_stiffness),
                   "nominal_area",
                   "is that of the part, but " + source +
                       " has forces or stiffnesses of a sample without stating its area; write a "
                       "line such as '# nominal_area: 1 mm^2' into it");
      sample.force = sample.pressure * area;
    }
    sample.force *= ratio;
    sample.normal_stiffness *= ratio;
    sample.tangential_stiffness *= ratio;
  }
  curve.nominal_area = area;
  return curve;
}

std::unique_ptr<const ContactLaw> law_of_part(std::shared_ptr<const ContactLaw> sample,
                                              double ratio) {
  return std::make_unique<LawOfPart>(std::move(sample), ratio);
}

}  // namespace salebra
