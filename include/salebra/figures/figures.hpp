// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <salebra/damping/oscillation.hpp>
#include <salebra/figures/figure.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/spectrum.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {
class BearingCurve;
class ContactLaw;
class IndenterLaw;
struct AsperityDamping;
struct Assumptions;
struct AssumptionVerdict;
struct ContactSetAt;
struct ContactSpots;
struct Correlation;
struct CorrelationMap;
struct CycleResult;
struct DamperMap;
struct DamperSolution;
struct DampingPoint;
struct DampingResult;
struct ExponentialFit;
struct ForceCurve;
struct FrictionMap;
struct HeightHistogram;
struct JointLoss;
struct LocalDecayLength;
struct ModelResult;
struct NormalContactState;
struct OscillationOutcome;
struct ParameterLists;
struct Profile;
struct Realisation;
struct RegimeMap;
struct ScaleDependence;
struct SliderMotion;
struct SlidingPoint;
struct SlidingProblem;
struct SpotStatistics;
struct StressMap;
struct StudyResult;
struct StudySensitivity;
struct StudySolution;
struct SummitList;
struct Surface;
struct SurfacePicture;
struct SurfaceTwin;
struct TrajectoryDamping;
struct ViscoelasticCycle;
struct ViscoelasticDamping;
struct ViscoelasticIndentation;
struct ViscoelasticLoss;
struct ViscoelasticPath;
}  // namespace salebra

/// The figures of results: what is drawn of each, for every renderer.
///     const Figure figure = figure_of(curve, fit);
/// The numbers in a figure are those of the result. Throws InvalidInput for a result without
/// anything to draw. Cost: that of copying the numbers, unless stated otherwise.
namespace salebra::figures {

/// Adds to the headlines of damping constants and losses, "γ = 14.1 N s/m", what these assumptions
/// say of the result: "not valid", "valid with care", and why, or "validity not checked". A figure
/// without such a headline gets it in its caption.
void state_validity(Figure& figure, std::span<const AssumptionVerdict> verdicts);
/// Likewise, of the assumptions in each case; without any, nothing was checked.
void state_validity(Figure& figure, std::span<const Assumptions> cases, bool slip_followed);

/// One curve of two quantities by their names in JSON and files, which give labels and units; an axis
/// is logarithmic where positive values span more than 1.5 decades. It draws results without a figure
/// of their own, such as lists of means with their limits:
///     curve_figure("pressure", "spot_count", {.x = pressures, .y = counts, .low = low, .high = high})
Figure curve_figure(std::string_view x, std::string_view y, Curve curve);

/// The spectrum of a surface. A spectrum needs every point, so it is empty if a point is undefined.
struct SurfaceSpectrum {
  std::optional<PowerSpectrum> spectrum;
  SelfAffineFit law;  ///< of the mean over all directions
  /// On a surface with a lay: the laws of profiles across and along it.
  std::optional<DirectionalSelfAffineFit> of_lay = {};
  SurfaceLay lay = {};
};

/// Cost: a Fourier transform, and the fits of the laws.
SurfaceSpectrum spectrum_of(const Surface& surface);

/// A surface in three panels: the map of its heights; its power spectral density, that of profiles
/// across and along its lay if it has one, with 95 % intervals, the fitted laws, roll-off and
/// cut-off; the distribution of its heights with the Gaussian of the same mean and rms height. The
/// second panel is left out if there is no spectrum or if it is zero.
Figure figure_of(const Surface& surface, const SurfaceSpectrum& of);
Figure figure_of(const Surface& surface);
/// Spectra, heights and correlations.
Figure figure_of(const PowerSpectrum& spectrum);
Figure figure_of(const RadialSpectrum& spectrum);
Figure figure_of(const ProfilePsd& spectrum);
Figure figure_of(const HeightHistogram& histogram);
Figure figure_of(const BearingCurve& curve);
Figure figure_of(const Correlation& correlation);
Figure figure_of(const CorrelationMap& map);
Figure figure_of(const ScaleDependence& slopes);
Figure figure_of(const Profile& profile);
/// The distribution of the heights of summits.
Figure figure_of(const SummitList& summits);
/// The maps that a study keeps of a surface: heights, pressure of first touch, contact pressure and
/// gap, as far as they are there; spectrum with the self-affine law; distribution of heights.
/// pressures: of the study, Pa; empty: unknown, and the map of first touch is left out.
Figure figure_of(const SurfacePicture& picture, const std::vector<double>& pressures);

/// The power spectral density of a surface twin, which several scans have in common, with its 95 %
/// band.
Figure figure_of(const SurfaceTwin& twin);

/// Pressure over mean gap with the fitted law and the window of the fit. Area and stiffness too, if
/// the curve has them; with a fit also the local decay length and the deviation from the fit. Throws InvalidInput for a curve without a converged sample.
Figure figure_of(const ForceCurve& curve, const std::optional<ExponentialFit>& fit);

/// Pressure over indentation of loading and unloading; pressures may be tensile.
Figure figure_of(const ForceCurve& loading, const ForceCurve& unloading);

/// Maps of pressure (white where the bodies do not touch) and gap.
Figure figure_of(const Grid2D& grid, const NormalContactState& state);
/// Force over indentation of a law at these indentations, m.
Figure figure_of(const ContactLaw& law, const std::vector<double>& indentation);
/// Pressure over mean gap of all models of one surface.
Figure figure_of(const Realisation& surface);
/// The local decay length over the mean gap.
Figure figure_of(const LocalDecayLength& local);
/// The number of spots at least as large as an area, and the number in classes of size that double.
Figure figure_of(const ContactSpots& spots);
Figure figure_of(const SpotStatistics& spots);

/// An indenter at rest (Fig. 1 of the paper): its profile and the deformed surface, the
/// one-dimensional image on its springs, the pressure, and force F(δ) with contact radius a(δ).
Figure figure_of(const IndenterLaw& law, double indentation);

/// One period of a motion (Fig. 2 of the paper): the path of a point of the body with the spring
/// that it carries and releases, the loop F_x(x), and the cumulative loss W(t).
Figure figure_of(const SampledMotion& path, const TrajectoryDamping& loss);

/// The path of a point of the body, and the loop F_x(x) of a cycle with its loss.
Figure figure_of(const SampledMotion& path);
Figure figure_of(const CycleResult& cycle);

/// The loss W and its small-amplitude formula, their ratio and, if known, the damping constant γ,
/// over the quantity of which `values` has several values; results: for each direction one of each
/// value.
Figure figure_of(std::string_view quantity, const std::vector<double>& values,
                 const std::vector<DampingResult>& results);

/// Fig. 4 of the paper: shear stress τ and pressure p over radius and phase, and τ(r) at two
/// phases, one while the indenter is pressed in and one while it is pulled out.
Figure figure_of(const IndenterLaw& law, double indentation, const Oscillation& motion,
                 const StressMap& map);

/// Shear stress and pressure over radius and phase alone.
Figure figure_of(const StressMap& map);

/// The loss with friction divided by the loss without slip, W(μ)/W(∞), over the friction number M =
/// μu_zK/(u_xK_t) and the phase φ0, with lines at which it deviates from 1 by 1, 5 and 10 %.
/// Further panels: this deviation over M; the parts of slip and relaxation.
Figure figure_of(const FrictionMap& map);

/// Damping constant γ over u_z and ω, with the limit of stable sliding if a falling slope of
/// friction is given; a line if only one of u_z and ω varies. Further panels: free decay of the
/// oscillator; the smallest stabilising amplitude over the frequency. A result that is a single
/// number has no panel. angular_frequency: rad/s, of the stabilising amplitudes.
Figure figure_of(const DamperSolution& answer, std::optional<double> falling_slope,
                 const std::vector<double>& angular_frequency);

/// Damping constant γ over u_z and ω.
Figure figure_of(const DamperMap& map);
/// The losses of the summits in decreasing order.
Figure figure_of(const AsperityDamping& loss);

/// Friction and losses over the velocity, for one amplitude.
Figure figure_of(const std::vector<SlidingPoint>& points, double friction);
/// Mean friction and its derivative with respect to the velocity, over velocity and normal
/// amplitude.
Figure figure_of(const std::vector<SlidingPoint>& points, const SlidingProblem& problem);
/// Loss with slip divided by the loss without slip, over velocity and excursion, with the borders
/// of the regimes (no slip, partial slip, lifts off, sliding). angular_frequency: rad/s.
Figure figure_of(const RegimeMap& map, double angular_frequency);
/// Velocity and spring force of a slider over the time, by the full and by the averaged equation.
/// stiffness: of its spring, N/m.
Figure figure_of(const SliderMotion& full, const SliderMotion& averaged, double stiffness);

/// Distance of a slider from its drive over the time.
Figure figure_of(const SliderMotion& motion);

/// The loss of a joint over the tangential force, and the loop of its largest motion with the
/// backbone, of which the loop is twice the size (Masing). displacement, force: of the loop, m and
/// N. limits: low and high, J, of each loss of several joints; empty: the errors of the losses.
Figure figure_of(const std::vector<JointLoss>& losses, const std::vector<double>& displacement,
                 const std::vector<double>& force, double normal_force, double friction_coefficient,
                 const std::array<std::vector<double>, 2>& limits = {});

/// Fig. 3 of the paper: for each outcome the map of the cells (black if always in contact, grey if in
/// contact during a part of the cycle) and the work over the time, at equal frequencies W(t) divided
/// by the loss of Eq. (12), under a drag the energy released so far divided by the loss of Eq. (15),
/// and without a loss W(t) divided by ½K_t u²; with friction also the loops of force over
/// displacement. names: of the outcomes. assumptions: of each outcome, for the headlines; empty:
/// they say nothing on validity.
Figure figure_of(const std::vector<OscillationOutcome>& outcomes,
                 const std::vector<std::string>& names,
                 std::span<const Assumptions> assumptions = {});

/// The losses on a viscoelastic body and the parts of its complex modulus, over the quantity of which
/// `values` has one for each loss.
Figure figure_of(std::string_view quantity, const std::vector<double>& values,
                 const std::vector<ViscoelasticLoss>& losses);

/// The losses of a rough contact on a viscoelastic body and its dynamic stiffnesses, over the quantity
/// of which `values` has one for each cycle.
Figure figure_of(std::string_view quantity, const std::vector<double>& values,
                 const std::vector<ViscoelasticCycle>& cycles);

/// Indentation, or pressure where the indentation is held, and contact area over the time.
Figure figure_of(const ViscoelasticPath& path);

/// Gap with the fitted law, area, stiffness, damping and stiffness ratio of all models over the
/// pressure, with 95 % bands and the damping constants of the study's table with their errors; local
/// decay lengths; damping over that of the boundary elements. A quantity that no model computes has
/// no panel. One point of the parameter grid gives two panels in a row. Several points give a
/// column each, and the panels of a row share their axes. varied: the parameters whose values are
/// the titles of the columns. A report has the same panels.
Figure figure_of(const std::vector<StudyResult>& results, const ParameterLists& varied);
Figure figure_of(const StudyResult& result);
/// How results respond to each band of waves at a pressure, over the geometric mean of its
/// wavelengths, with 95 % limits; no panel without bands. index: of the pressure.
Figure figure_of(const StudySensitivity& found, std::size_t index);
/// The same at the middle pressure.
Figure figure_of(const StudySensitivity& found);
/// The damping constants over the pressure with their 95 % limits, or with their numerical errors for
/// a single surface; without slip too.
Figure figure_of(const StudySolution& solution);

/// Forces along a path or in a period, at each step.
Figure figure_of(const TrajectoryDamping& loss);
Figure figure_of(const ViscoelasticDamping& loss);
Figure figure_of(const ViscoelasticIndentation& contact);
/// The cells in contact.
Figure figure_of(const ContactSetAt& set);
/// The map of regimes without the line of one normal cycle, which needs the frequency.
Figure figure_of(const RegimeMap& map);
/// The fitted law alone, in its window.
Figure figure_of(const ExponentialFit& fit);
/// The curve of one model of a study with its fit, and the damping constants of one model.
Figure figure_of(const ModelResult& result);
Figure figure_of(const std::vector<DampingPoint>& points);

}  // namespace salebra::figures
