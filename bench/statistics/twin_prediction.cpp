// SPDX-License-Identifier: GPL-3.0-or-later
// What surfaces of a twin say of the contact of a known surface, beside what the same scans say one
// by one: stiffness K, contact area and damping constant at one nominal pressure.
//   twin_prediction [truths [points of a scan [surfaces of an ensemble [first seed]]]]
// Truths have their roll-off at 8 … 24 µm and their shortest wave at 2 … 4 µm, which the scans of
// synthetic_scans.hpp see together and none alone. Contacts are of 192² points and 96 µm.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <salebra/contact/sweep.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/twin_file.hpp>
#include <salebra/surface/detrend.hpp>
#include <string>
#include <variant>

#include "synthetic_scans.hpp"

namespace {

using namespace salebra;
using std::numbers::pi;

constexpr double modulus = 115e9, size = 96e-6;
constexpr int points = 192;
constexpr std::size_t middle = 2;  // of four pressures

/// Pressures about a hundredth of E*h', in geometric progression.
double first_pressure(double slope) { return 3e-3 * modulus * slope; }
double last_pressure(double slope) { return 3e-2 * modulus * slope; }

StudyResult ensemble(std::vector<SpectrumTable> tables, double slope, int surfaces,
                     int first_seed) {
  StudyConfiguration configuration = parse_study_configuration(
      fmt::format(
          "[surface]\npoints = {}\nsize_x = {}\nhurst = 0.8\nrolloff = \"10um\"\n"
          "short_cutoff = \"2um\"\nrms_height = \"100nm\"\nfirst_seed = {}\nseed_count = {}\n"
          "[material]\ncontact_modulus = {}\npoisson = 0.3\n"
          "[contact]\npressures = \"{}:{}:4\"\ntolerance = 1e-6\n"
          "tangential_stiffness = \"proportional\"\n"
          "[damping]\nmode = \"drag\"\nnormal_amplitude = \"1nm\"\n"
          "drag_velocity = \"1um/s\"\nfrequency = \"20kHz\"\nintervals = 0\n",
          points, size, first_seed, surfaces, modulus, first_pressure(slope), last_pressure(slope)),
      "bench");
  std::get<GeneratedSurfaces>(configuration.surfaces).tables = std::move(tables);
  return run_study(configuration);
}

/// Contacts of each surface of an ensemble, at the pressure in the middle.
struct Contacts {
  std::vector<double> stiffness, area, damping;
};

Contacts contacts_of(const StudyResult& result) {
  Contacts contacts;
  for (const Realisation& one : result.realisations) {
    const ModelResult& bem = one.of(ContactModel::bem);
    contacts.stiffness.push_back(bem.curve.samples[middle].normal_stiffness /
                                 bem.curve.nominal_area);
    contacts.area.push_back(bem.curve.samples[middle].contact_area_fraction);
    contacts.damping.push_back(bem.damping[middle].damping_constant_closed_form);
  }
  return contacts;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

/// The equal-weight mean of the scans' periodograms in ten bins a decade.
SpectrumTable plain_mean(const std::vector<ScanSpectrum>& scans) {
  struct Sum {
    double wavenumber = 0, psd = 0, count = 0;
  };
  std::map<int, Sum> bins;
  for (const ScanSpectrum& scan : scans)
    for (std::size_t k = 0; k < scan.psd.size(); ++k) {
      if (scan.modes[k] == 0) continue;
      Sum& sum = bins[static_cast<int>(std::floor(10 * std::log10(scan.wavenumber[k])))];
      sum.wavenumber += std::log(scan.wavenumber[k]);
      sum.psd += scan.psd[k];
      ++sum.count;
    }
  SpectrumTable table;
  const double nyquist = pi * points / size;
  for (const auto& [bin, sum] : bins) {
    const double q = std::exp(sum.wavenumber / sum.count);
    if (q > nyquist) break;
    table.wavenumber.push_back(q);
    table.psd.push_back(sum.psd / sum.count);
  }
  return table;
}

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1) + 0.5)];
}

struct Coverage {
  int held = 0, asked = 0, means = 0, truths = 0;
  std::vector<double> ratios;

  void add(const EnsembleMean& twin, const EnsembleMean& known, const std::vector<double>& values) {
    for (const double value : values) {
      held += twin.low <= value && value <= twin.high;
      ++asked;
    }
    const double mean = geometric_mean(values);
    means += twin.low <= mean && mean <= twin.high;
    ++truths;
    ratios.push_back(std::log(twin.high / twin.low) / std::log(known.high / known.low));
  }
  void print(const char* name) const {
    std::printf(
        "  %-10s %4d of %4d surfaces (%.0f %%), mean of %d of %d truths; width over that of "
        "known parameters: median %.2f, middle half %.2f to %.2f\n",
        name, held, asked, 100.0 * held / asked, means, truths, quantile(ratios, 0.5),
        quantile(ratios, 0.25), quantile(ratios, 0.75));
  }
};

}  // namespace

int main(int argc, char** argv) {
  const int truths = argc > 1 ? std::atoi(argv[1]) : 30;
  const Index n = argc > 2 ? std::atoi(argv[2]) : 256;
  const int surfaces = argc > 3 ? std::atoi(argv[3]) : 12;
  const int first = argc > 4 ? std::atoi(argv[4]) : 1;
  const Material material = Material::of_contact_modulus(modulus, 0.3);
  std::map<std::string, Coverage> coverages;
  std::map<std::string, std::vector<double>> stiffness, area;
  std::vector<double> shares;
  const std::vector<std::string> rows{"one optical map",  "one scan of 40 µm", "one scan of 10 µm",
                                      "all optical maps", "plain average",     "twin"};
  for (int number = first; number < first + truths; ++number) {
    RoughPatches patches(static_cast<unsigned>(number));
    synthetic::Truth truth;
    truth.spectrum.reference = 2e6;
    truth.spectrum.hurst = patches.uniform(0.4, 0.95);
    truth.spectrum.rolloff = synthetic::log_uniform(patches, 8e-6, 24e-6);
    truth.spectrum.short_cutoff = synthetic::log_uniform(patches, 2e-6, 4e-6);
    synthetic::set_slope(truth, synthetic::log_uniform(patches, 0.03, 0.2));
    const double slope = truth.rms_slope;
    // Each ensemble has surfaces of its own.
    const int seeds = 1000 * number;

    const SpectrumTable exact = tabulated(truth.spectrum, pi / size);
    const StudyResult known = ensemble({exact, exact}, slope, surfaces, seeds + 500);
    const Contacts real = contacts_of(known);
    const double k = geometric_mean(real.stiffness), a = geometric_mean(real.area);
    const auto note = [&](const std::string& row, double of_stiffness, double of_area) {
      stiffness[row].push_back(of_stiffness / k);
      area[row].push_back(of_area / a);
    };

    std::vector<ScanSpectrum> scans;
    std::vector<double> optical_stiffness, optical_area;
    synthetic::for_each_scan(
        truth, n, patches,
        [&](Field heights, const Grid2D& grid, const ScanInstrument& instrument) {
          scans.push_back(scan_spectrum(heights, grid, instrument));
          Surface surface;
          surface.grid = grid;
          surface.heights = std::move(heights);
          SweepOptions options;
          options.stiffness = true;
          options.contact.tolerance = 1e-6;
          const double pressure = first_pressure(slope) * std::pow(10, middle / 3.0);
          const ForceCurve curve = sweep_pressures(detrended(std::move(surface), Detrend::plane),
                                                   material, {pressure}, options);
          const ForceSample& sample = curve.samples.front();
          const double of_stiffness = sample.normal_stiffness / curve.nominal_area;
          note(instrument.kind == Instrument::optical ? rows[0]
               : grid.lx > 20e-6                      ? rows[1]
                                                      : rows[2],
               of_stiffness, sample.contact_area_fraction);
          if (instrument.kind != Instrument::optical) return;
          optical_stiffness.push_back(of_stiffness);
          optical_area.push_back(sample.contact_area_fraction);
        });
    note(rows[3], geometric_mean(optical_stiffness), geometric_mean(optical_area));
    const Contacts plain = contacts_of(ensemble({plain_mean(scans)}, slope, 4, seeds + 900));
    note(rows[4], geometric_mean(plain.stiffness), geometric_mean(plain.area));

    const SurfaceTwin twin = fit_twin(scans, {.leave_one_out = false});
    const Grid2D grid{points, points, size, size};
    const StudyResult drawn = ensemble(tables_of(twin.draws, grid), slope, surfaces, seeds);
    const Contacts said = contacts_of(drawn);
    note(rows[5], geometric_mean(said.stiffness), geometric_mean(said.area));
    shares.push_back(drawn.scan_share());
    const NumberOf<ForceSample> of_stiffness = [](const ForceSample& sample) {
      return sample.normal_stiffness;
    };
    const NumberOf<DampingPoint> of_damping = [](const DampingPoint& point) {
      return point.damping_constant_closed_form;
    };
    std::vector<double> whole = real.stiffness;
    for (double& value : whole) value *= size * size;
    coverages["K"].add(drawn.curve(of_stiffness)[middle], known.curve(of_stiffness)[middle], whole);
    coverages["γ"].add(drawn.damping(of_damping)[middle], known.damping(of_damping)[middle],
                       real.damping);
    std::fprintf(stderr, "%d H %.2f lr %.1f ls %.2f: K %.3g, twin %.2f, area %.2f, γ %.2f\n",
                 number, truth.spectrum.hurst, truth.spectrum.rolloff * 1e6,
                 truth.spectrum.short_cutoff * 1e6, k, stiffness[rows[5]].back(),
                 area[rows[5]].back(), geometric_mean(said.damping) / geometric_mean(real.damping));
  }
  std::printf(
      "%d truths, scans of %ld² points, %d surfaces each; in the 95 %% interval of a twin:\n",
      truths, static_cast<long>(n), surfaces);
  for (const auto& [name, coverage] : coverages) coverage.print(name.c_str());
  std::printf("  of the variance the scans leave open: median %.2f\n\n", quantile(shares, 0.5));
  std::printf(
      "| from | K over the truth's, median (5 … 95 %%) | contact area over the truth's |\n"
      "|---|---|---|\n");
  for (const std::string& row : rows) {
    const auto text = [](const std::vector<double>& values) {
      return fmt::format("{:.2f} ({:.2f} … {:.2f})", quantile(values, 0.5), quantile(values, 0.05),
                         quantile(values, 0.95));
    };
    std::printf("| %s | %s | %s |\n", row.c_str(), text(stiffness[row]).c_str(),
                text(area[row]).c_str());
  }
}
