// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The questions that salebra answers, and what they are put together from: a surface that is made
// or read, a curve that is swept or read, a study. For programs that link salebra::study; the
// libraries below it have headers for each thing.
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/questions/contact.hpp>
#include <salebra/questions/damping.hpp>
#include <salebra/questions/oscillation.hpp>
#include <salebra/questions/sliding.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <salebra/study/study.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>
