// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>

/// Quantities that several damping results share, for their describe() functions:
///
///     visit(&S::power, quantity::power);
namespace salebra::quantity {

inline constexpr Quantity angular_frequency{"angular_frequency", Dimension::angular_frequency,
                                            "angular frequency"},
    contact_time{"contact_time", Dimension::dimensionless,
                 "share of the period in which the bodies touch"},
    damping_constant{"damping_constant", Dimension::damping, "damping constant P/v^2"},
    damping_constant_error{"damping_constant_error", Dimension::damping,
                           "numerical error of the damping constant"},
    damping_constant_without_slip{"damping_constant_without_slip", Dimension::damping,
                                  "damping constant P/v^2 without slip"},
    dissipated{"dissipated", Dimension::energy, "energy dissipated since the start"},
    drag_velocity{"drag_velocity", Dimension::velocity, "drag velocity"},
    error_estimate{"error_estimate", Dimension::energy,
                   "estimated error of the energy dissipated in a cycle"},
    excursion{"excursion", Dimension::length,
              "distance between the turning points of a slow motion"},
    force{"force", Dimension::force, "normal force"},
    force_curvature{"force_curvature", Dimension::force_curvature,
                    "second derivative of force by indentation"},
    friction_coefficient{"friction_coefficient", Dimension::dimensionless,
                         "coefficient of friction: Coulomb's, or of the mean forces of a cycle"},
    full_stick_work{"full_stick_work", Dimension::energy,
                    "energy dissipated in a cycle without slip"},
    indentation{"indentation", Dimension::length, "indentation"},
    loss_factor{"loss_factor", Dimension::dimensionless,
                "energy dissipated over 2 pi times energy stored"},
    max_force{"max_force", Dimension::force, "normal force, maximum of a cycle"},
    mean_force{"mean_force", Dimension::force, "normal force, mean over a cycle"},
    normal_amplitude{"normal_amplitude", Dimension::length, "amplitude of the normal oscillation"},
    normal_stiffness{"normal_stiffness", Dimension::stiffness,
                     "normal stiffness dF/d(indentation)"},
    phase{"phase", Dimension::angle, "phase between the oscillations"},
    power{"power", Dimension::power, "mean dissipated power"},
    relaxation_share{"relaxation_share", Dimension::dimensionless,
                     "part of the energy dissipated by springs that open and close"},
    relaxation_work{"relaxation_work", Dimension::energy,
                    "energy dissipated in a cycle by contacts that open"},
    slip_share{"slip_share", Dimension::dimensionless,
               "part of the energy dissipated by slip in permanent contact"},
    slip_work{"slip_work", Dimension::energy,
              "energy dissipated in a cycle by slip in permanent contact"},
    small_amplitude_work{"small_amplitude_work", Dimension::energy,
                         "energy dissipated in a cycle, small-amplitude form"},
    storage_stiffness{"storage_stiffness", Dimension::stiffness,
                      "mean tangential stiffness in phase with the motion"},
    tangential_amplitude{"tangential_amplitude", Dimension::length,
                         "amplitude of the tangential oscillation"},
    tangential_force{"tangential_force", Dimension::force, "tangential force"},
    tangential_stiffness{"tangential_stiffness", Dimension::stiffness,
                         "tangential stiffness in full stick"},
    time{"time", Dimension::time, "time"},
    work_per_cycle{"work_per_cycle", Dimension::energy, "energy dissipated in a cycle"},
    work_per_cycle_error{"work_per_cycle_error", Dimension::energy,
                         "numerical error of work_per_cycle"};

}  // namespace salebra::quantity
