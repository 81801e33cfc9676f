// SPDX-License-Identifier: GPL-3.0-or-later
// How often the 95 % intervals of a surface twin hold the truth, over synthetic surfaces and
// instruments.
//   twin_coverage [truths [points [rolloff [skewness [form [first seed]]]]]]
// rolloff: inside (20 … 90 µm), beyond (600 … 3000 µm), both in turn; form: corner or smooth
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/twin.hpp>
#include <string>

#include "synthetic_scans.hpp"

namespace {

using namespace salebra;
using synthetic::log_uniform;
using synthetic::Truth;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<ScanSpectrum> scans_of(const Truth& truth, Index n, RoughPatches& patches,
                                   double& spent) {
  std::vector<ScanSpectrum> scans;
  synthetic::for_each_scan(
      truth, n, patches, [&](Field heights, const Grid2D& grid, const ScanInstrument& instrument) {
        const auto start = std::chrono::steady_clock::now();
        scans.push_back(scan_spectrum(heights, grid, instrument));
        spent += seconds_since(start);
      });
  return scans;
}

struct Tally {
  int asked = 0, covered = 0, below = 0;
  std::vector<double> widths, errors;

  void add(const TwinParameter& parameter, double truth, bool logarithm) {
    const auto scaled = [&](double value) { return logarithm ? std::log(value) : value; };
    ++asked;
    covered += parameter.low <= truth && truth <= parameter.high;
    below += truth < parameter.low;
    widths.push_back(scaled(parameter.high) - scaled(parameter.low));
    errors.push_back(scaled(parameter.value) - scaled(truth));
  }
  void add_limit(bool holds) {
    ++asked;
    covered += holds;
  }
  void print(const char* name) const {
    if (asked == 0) return;
    std::printf("  %-22s %3d of %3d (%.0f %%)", name, covered, asked, 100.0 * covered / asked);
    if (!widths.empty()) {
      std::vector<double> sorted = widths;
      std::sort(sorted.begin(), sorted.end());
      double sum = 0, square = 0;
      for (const double error : errors) {
        sum += error;
        square += error * error;
      }
      const auto count = static_cast<double>(errors.size());
      std::printf("  truth below %d  median width %.3f  bias %+.4f ± %.4f  rms error %.4f", below,
                  sorted[sorted.size() / 2], sum / count,
                  std::sqrt(std::max(0.0, square / count - sum * sum / count / count) / count),
                  std::sqrt(square / count));
    }
    std::printf("\n");
  }
};

}  // namespace

int main(int argc, char** argv) {
  parallel::set_threads(1);
  const int truths = argc > 1 ? std::atoi(argv[1]) : 50;
  const Index n = argc > 2 ? std::atoi(argv[2]) : 512;
  const std::string where = argc > 3 ? argv[3] : "both";
  const double skewness = argc > 4 ? std::atof(argv[4]) : 0;
  const bool smooth = argc > 5 && std::strcmp(argv[5], "smooth") == 0;
  const int first = argc > 6 ? std::atoi(argv[6]) : 1;
  std::map<std::string, Tally> tallies;
  int seen = 0, seen_inside = 0, inside_count = 0, right_form = 0, tables = 0, dropped = 0,
      disagree = 0;
  double spectra = 0, fits = 0;
  std::vector<double> misfits;
  for (int number = first; number < first + truths; ++number) {
    RoughPatches patches(static_cast<unsigned>(number));
    Truth truth;
    truth.bend = skewness < 0 ? 0.3143 : 0;  // skewness −1
    const bool inside = where == "inside" || (where == "both" && number % 2 == 0);
    TwinDraw& spectrum = truth.spectrum;
    spectrum.form = smooth ? SpectrumForm::smooth : SpectrumForm::corner;
    spectrum.hurst = patches.uniform(0.3, 0.95);
    spectrum.rolloff =
        inside ? log_uniform(patches, 20e-6, 90e-6) : log_uniform(patches, 600e-6, 3000e-6);
    spectrum.short_cutoff = log_uniform(patches, 0.3e-6, 1e-6);
    spectrum.reference = 2e6;
    synthetic::set_slope(truth, log_uniform(patches, 0.03, 0.25));
    const std::vector<ScanSpectrum> scans = scans_of(truth, n, patches, spectra);
    const auto start = std::chrono::steady_clock::now();
    const SurfaceTwin twin = fit_twin(scans);
    fits += seconds_since(start);
    misfits.push_back(twin.misfit);
    tables += twin.form == SpectrumForm::table;
    right_form += twin.form == spectrum.form;
    for (const TwinScan& scan : twin.scans) dropped += scan.left_out;
    for (const TwinWithout& without : twin.without) disagree += !without.agrees;
    inside_count += inside;
    seen += twin.rolloff.seen;
    seen_inside += twin.rolloff.seen && inside;
    if (twin.hurst.found()) tallies["H"].add(twin.hurst, spectrum.hurst, false);
    if (twin.rolloff.seen)
      tallies["roll-off"].add(twin.rolloff, spectrum.rolloff, true);
    else if (twin.hurst.found())
      tallies["roll-off, low limit"].add_limit(twin.rolloff.low < spectrum.rolloff);
    if (twin.short_cutoff.seen)
      tallies["short cut-off"].add(twin.short_cutoff, spectrum.short_cutoff, true);
    else
      tallies["short cut-off, limit"].add_limit(twin.short_cutoff.high > spectrum.short_cutoff);
    if (twin.rms_height.found())
      tallies["rms height"].add(twin.rms_height, spectrum.rms_height, true);
    else
      tallies["rms height, low limit"].add_limit(twin.rms_height.low < spectrum.rms_height);
    tallies["rms slope"].add(twin.rms_slope, truth.rms_slope, true);
    std::fprintf(stderr,
                 "%3d H %.3f [%.3f %.3f] lr %.1f [%.1f %.1f]%s ls %.3f [%.3f %.3f]%s h %.3g [%.3g "
                 "%.3g] h' %.4f [%.4f %.4f] %s misfit %.2f LRs %.1f %.1f form %.1f\n",
                 number, spectrum.hurst, twin.hurst.low, twin.hurst.high, spectrum.rolloff * 1e6,
                 twin.rolloff.low * 1e6, twin.rolloff.high * 1e6, twin.rolloff.seen ? "" : "?",
                 spectrum.short_cutoff * 1e6, twin.short_cutoff.low * 1e6,
                 twin.short_cutoff.high * 1e6, twin.short_cutoff.seen ? "" : "?",
                 spectrum.rms_height, twin.rms_height.low, twin.rms_height.high, truth.rms_slope,
                 twin.rms_slope.low, twin.rms_slope.high, std::string(name_of(twin.form)).c_str(),
                 twin.misfit, twin.rolloff_ratio, twin.cutoff_ratio, twin.form_ratio);
    for (const std::string& warning : twin.warnings)
      std::fprintf(stderr, "      %s\n", warning.c_str());
  }
  std::sort(misfits.begin(), misfits.end());
  std::printf(
      "%d truths, %ld points a side, roll-off %s, skewness %g, %s: roll-off seen in %d of %d "
      "inside and %d of %d beyond, form right in %d, table %d, scans dropped %d, instruments "
      "doubted %d, misfit median %.2f largest %.2f, %.2f s spectra, %.2f s fit each\n",
      truths, static_cast<long>(n), where.c_str(), skewness, smooth ? "smooth" : "corner",
      seen_inside, inside_count, seen - seen_inside, truths - inside_count, right_form, tables,
      dropped, disagree, misfits[misfits.size() / 2], misfits.back(), spectra / truths,
      fits / truths);
  for (const auto& [name, tally] : tallies) tally.print(name.c_str());
}
