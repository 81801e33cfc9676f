// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "surface/twin_law.hpp"
#include "surface/twin_response.hpp"

namespace salebra::twin_detail {

/// Scans of one instrument, size and grid (a group), with the bins that the fit uses.
struct TwinData {
  std::vector<std::size_t> scans;  ///< indices into the list of all scans
  std::string instrument;
  double height_calibration = 0, scan_calibration = 0;
  double mean_scans = 1;     ///< effective number of scans, (Σw)²/Σw² for weights w
  double blur = 0;           ///< standard deviation of the optical blur, m
  double noise = 0;          ///< power of the noise, in the unit of psd
  double noise_freedom = 0;  ///< standard deviation of the noise parameter
  Lay lay;
  bool tip = false;
  bool tail = false;  ///< whether there is power beyond the cut-off: of a tip, or of skew heights
  double tip_limit = 0;       ///< bins from here on are left out for the tip, rad/m; 0: none
  double tail_reference = 0;  ///< wave number at which a tip's tail is given, rad/m

  std::vector<std::size_t> bins;  ///< indices into the bins of the scans
  std::vector<double> wavenumber, psd;
  std::vector<double> modes;                ///< m_c: number of independent modes
  std::vector<double> leaked;               ///< power that the window leaks from much longer waves
  std::vector<double> psd_error;            ///< relative error of psd due to tip and leakage
  std::vector<double> scatter;              ///< variance of psd over that of a mean of m_c modes
  std::vector<double> cell_low, cell_high;  ///< ln q of the limits of cells of the spectrum
  std::vector<double> cell_wavenumber;
  std::vector<double> weights;  ///< [cell][bin used]: power of a bin per C of a cell
};

/// Keeps the responses of scans by grid, in modes, to compute each only once; the lay is always the
/// same.
class Responses {
 public:
  const Response& of(const Grid2D& grid, bool drifts, const Lay& lay);

 private:
  std::map<std::tuple<Index, Index, double, bool>, Response> known_;
};

/// Groups the scans that are not left out, and selects bins by their number of modes and by what a
/// tip follows. The spectrum of a group is the weighted mean of its scans.
/// With a lay, bins and wave numbers are elliptic.
std::vector<TwinData> grouped(const std::vector<ScanSpectrum>& scans,
                              const std::vector<bool>& left_out, const Lay& lay,
                              Responses& responses);

/// Allows for heights that are not Gaussian: power beyond the cut-off, of sums of waves, and scans
/// that differ the more the smaller they are, since the slope of a skew surface changes with its
/// height. The scatter between scans is therefore that of each group.
void allow_skew_heights(const std::vector<ScanSpectrum>& scans, std::vector<TwinData>& data);

/// The scans of each group, without those left out.
std::vector<std::vector<std::size_t>> members_of(const std::vector<ScanSpectrum>& scans,
                                                 const std::vector<bool>& left_out);

/// Posterior density of the parameters: those of the law; for each group ln of its gain (factor of
/// the heights) and ln of the factor of its noise; for groups with tips ln of their tail (power
/// that a tip adds beyond the cut-off); and for blurred groups ln of the factor of the blur.
class TwinModel {
 public:
  /// Memory for one evaluation; each thread has its own.
  struct Work {
    std::vector<double> source, expected, signal, ratio;
    Eigen::MatrixXd slopes;
  };

  TwinModel(const std::vector<TwinData>& data, TwinLaw law);

  const TwinLaw& law() const { return law_; }
  const std::vector<TwinData>& data() const { return data_; }
  Index size() const { return size_; }
  Index bins() const { return bins_; }
  /// Bounds of the parameters; only those of the parameters of the law are narrow.
  const Eigen::VectorXd& lowest() const { return lowest_; }
  const Eigen::VectorXd& highest() const { return highest_; }
  double max_scan() const { return largest_; }          ///< side of the largest scan, m
  double finest_wavenumber() const { return finest_; }  ///< of the bins used, rad/m

  /// Sets the tolerance s for the deviation of the data from the law. A bin counts as m modes with
  /// 1/m = 1/m_c + s² + (error of the bin)², where m_c is its number of independent modes. s is
  /// `everywhere` in general, `beyond` at wave numbers above 0.8 times `cutoff`, and three times
  /// `beyond` if a bin begins at the cut-off.
  void set_tolerance(double everywhere, double beyond, double cutoff);
  /// Counts each bin as fewer modes by this factor, for powers that scatter more than those of Gaussian
  /// heights. Lasts until the next set_tolerance().
  void set_scatter(double factor);

  /// ln of the posterior density, −½|F|² with the F of residuals(); −∞ out of bounds.
  double log_posterior(const Eigen::VectorXd& parameters, Work& work) const;
  /// Residuals F: those of the priors, then the signed deviance residuals of all bins; and the
  /// derivatives of F with respect to the parameters if `slopes` is not null.
  void residuals(const Eigen::VectorXd& parameters, Work& work, Eigen::VectorXd& values,
                 Eigen::MatrixXd* slopes) const;
  /// Expected powers in the bins of a group.
  std::vector<double> expected(const Eigen::VectorXd& parameters, std::size_t group) const;
  /// Deviance of a group's bins (sum of squared deviance residuals) and its expected value.
  struct Misfit {
    double deviance = 0, expected = 0, gain = 1;
    double ratio() const { return deviance / expected; }
  };
  Misfit misfit(const Eigen::VectorXd& parameters, std::size_t group) const;
  /// Deviance of other powers in the bins of a group, such as those of one scan, which have fewer
  /// modes by the factor `share` < 1. The gain of these powers, relative to that of the group, is
  /// fitted.
  Misfit misfit_of(const Eigen::VectorXd& parameters, std::size_t group,
                   const std::vector<double>& psd, double share) const;

  double gain(const Eigen::VectorXd& parameters, std::size_t group) const;

 private:
  struct Group {
    LawPoints points;
    std::vector<double> square;      // q², m⁻²
    std::vector<double> precisions;  // number m of modes that each bin counts as
    Index tail = -1, blur = -1;      // indices of the tail and blur parameters
  };

  Index gain_at(std::size_t group) const { return law_.size() + static_cast<Index>(group); }
  Index noise_at(std::size_t group) const { return gain_at(group + data_.size()); }
  /// Fills work.expected (expected power of each bin) and work.signal (the same without noise and
  /// tail). Returns the number of cells below the cut-off, whose densities, multiplied by the
  /// squared attenuation by blur, are in work.source.
  std::size_t evaluate(const Eigen::VectorXd& parameters, std::size_t group, Work& work) const;
  /// Derivatives of the expected powers of a group with respect to each parameter of the law and
  /// the blur, one column for each. Call evaluate() first; `cells` is the number that it returned.
  Eigen::MatrixXd slopes_of_expected(const Eigen::VectorXd& parameters, std::size_t group,
                                     std::size_t cells, Work& work) const;
  double tail(const Eigen::VectorXd& parameters, std::size_t group, std::size_t bin) const;
  Eigen::VectorXd priors(const Eigen::VectorXd& parameters) const;

  std::vector<TwinData> data_;
  TwinLaw law_;
  std::vector<Group> groups_;
  Eigen::MatrixXd gain_whitening_, prior_slopes_;
  Eigen::VectorXd lowest_, highest_;
  Index size_ = 0, bins_ = 0;
  double largest_ = 0, finest_ = 0;
};

}  // namespace salebra::twin_detail
