// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything to solve contact and damping problems, including their inputs: surfaces (generated or
// read), curves (swept or read) and studies. For programs that link salebra::study; each
// library below it has its own headers.
//
//     DampingSolution answer = solve(DampingProblem{.contact = ExponentialContact{30e-9, 0.8, {1}},
//                                                .motions = {Drag{1e-9, 1e-6, 1e5}}});
#include <salebra/analysis/contact.hpp>
#include <salebra/analysis/damping.hpp>
#include <salebra/analysis/oscillation.hpp>
#include <salebra/analysis/sliding.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/roughness_law.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/results/assumption_verdicts.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <salebra/study/design.hpp>
#include <salebra/study/sensitivity.hpp>
#include <salebra/study/study.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/filters.hpp>
#include <salebra/surface/moments.hpp>
