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

/// Scans of one instrument, size and grid, in the bins that are used.
struct TwinData {
  std::vector<std::size_t> scans;  ///< places in the list of all scans
  std::string instrument;
  double height_calibration = 0, scan_calibration = 0;
  double mean_scans = 1;     ///< scans whose own gains average out, (Σw)²/Σw²
  double blur = 0;           ///< σ, m
  double noise = 0;          ///< N, of the unit of psd
  double noise_freedom = 0;  ///< standard deviation of ν
  bool tip = false;
  double tip_limit = 0;       ///< rad/m from which bins were left out for the tip; 0 for none
  double tail_reference = 0;  ///< q_c, rad/m

  std::vector<std::size_t> bins;  ///< places in the scans' bins
  std::vector<double> wavenumber, psd;
  std::vector<double> modes;                ///< m_c: independent modes in the mean
  std::vector<double> leaked;               ///< that the window leaves of much longer waves
  std::vector<double> psd_error;                ///< relative error of psd by tip and leakage
  std::vector<double> scatter;              ///< variance of psd/E by that of m_c modes
  std::vector<double> cell_low, cell_high;  ///< ln q of the cells' limits
  std::vector<double> cell_wavenumber;
  std::vector<double> weights;  ///< [cell][bin used]
};

/// Responses by grid in modes, so that each kind is computed once.
class Responses {
 public:
  const Response& of(const Grid2D& grid, bool drifts);

 private:
  std::map<std::tuple<Index, Index, double, bool>, Response> known_;
};

/// Groups of the scans but for those left out; bins by modes and tips. Spectra are means by weight.
std::vector<TwinData> grouped(const std::vector<ScanSpectrum>& scans,
                              const std::vector<bool>& left_out, Responses& responses);

/// Posterior of the parameters (law; gains g and noises ν of all groups; tails τ of those with
/// tips; ln of the blur's factor of blurred ones).
class TwinModel {
 public:
  /// Room for an evaluation; each thread has its own.
  struct Work {
    std::vector<double> source, expected, signal, ratio;
    Eigen::MatrixXd slopes;
  };

  TwinModel(const std::vector<TwinData>& data, TwinLaw law);

  const TwinLaw& law() const { return law_; }
  const std::vector<TwinData>& data() const { return data_; }
  Index size() const { return size_; }
  Index bins() const { return bins_; }
  const Eigen::VectorXd& lowest() const { return lowest_; }  ///< bounds; of others than the law's,
  const Eigen::VectorXd& highest() const { return highest_; }  ///< far away
  double max_scan() const { return largest_; }             ///< m
  double finest_wavenumber() const { return finest_; }         ///< rad/m, used

  /// s of 1/m = 1/m_c + s² in all bins, to which the squared doubt of a bin comes, and in those
  /// beyond 0.8 of the wave number `cutoff`; three times that where a bin begins there.
  void set_tolerance(double everywhere, double beyond, double cutoff);

  /// −½|F|², or −∞ out of bounds; F of residuals().
  double log_posterior(const Eigen::VectorXd& parameters, Work& work) const;
  /// Priors, then signed deviance residuals of all bins; and their slopes.
  void residuals(const Eigen::VectorXd& parameters, Work& work, Eigen::VectorXd& values,
                 Eigen::MatrixXd* slopes) const;
  /// E of the bins of a group.
  std::vector<double> expected(const Eigen::VectorXd& parameters, std::size_t group) const;
  /// Deviance of a group's bins and what is expected of it.
  struct Misfit {
    double deviance = 0, expected = 0, gain = 1;
    double ratio() const { return deviance / expected; }
  };
  Misfit misfit(const Eigen::VectorXd& parameters, std::size_t group) const;
  /// The same of other powers in the bins of a group, from fewer modes by the factor `share` < 1
  /// and with a gain of their own, relative to the group's, which is found.
  Misfit misfit_of(const Eigen::VectorXd& parameters, std::size_t group,
                   const std::vector<double>& psd, double share) const;

  double gain(const Eigen::VectorXd& parameters, std::size_t group) const;

 private:
  struct Group {
    LawPoints points;
    std::vector<double> square;      // q², m⁻²
    std::vector<double> precisions;  // m
    Index tail = -1, blur = -1;      // places of their parameters
  };

  Index gain_at(std::size_t group) const { return law_.size() + static_cast<Index>(group); }
  Index noise_at(std::size_t group) const { return gain_at(group + data_.size()); }
  /// Fills work.expected, work.signal (E without noise and tail); returns the number of cells below
  /// the cut-off, whose C·M² is in work.source.
  std::size_t evaluate(const Eigen::VectorXd& parameters, std::size_t group, Work& work) const;
  /// Slopes of E of a group in the parameters of the law and in the blur, column by column, after
  /// evaluate(), which gave the cells.
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
