// SPDX-License-Identifier: GPL-3.0-or-later
// The C header as a co-simulation unit of FMI 3.0. The declarations follow the text of the standard
// (https://fmi-standard.org/docs/3.0/), sections 2.2 and 4.2.
#include "fmu.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <salebra/base/version.hpp>

#include "base/checksum.hpp"
#include "c_header.hpp"
#include "io/child_program.hpp"
#include "io/scratch_folder.hpp"
#include "io/zip_archive.hpp"

namespace salebra::detail {
namespace {

// The unit in C; value references are those of modelDescription.xml. A function of a part of the
// standard that the unit does not have returns fmi3Error.
constexpr std::string_view program =
    R"c(/* License of this file: MIT-0, https://opensource.org/license/mit-0 */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "@NAME@.h"

#define JOINED(a, b) a##b
#define PREFIXED(a, b) JOINED(a, b)
#ifdef FMI3_FUNCTION_PREFIX
#define FMI(name) PREFIXED(FMI3_FUNCTION_PREFIX, name)
#else
#define FMI(name) name
#endif

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef const uint32_t *references;
typedef const char *text;
enum { inputs = 3, variables = 8 };

/* time; indentation and displacements along x and y, given from outside; normal force, tangential
   forces and tangential work at the end of the last step */
typedef struct {
  double value[variables];
  @NAME@_state contact;
  bool running;
} unit;

static void set_forces(unit *u, @NAME@_forces forces) {
  u->value[4] = forces.normal_force;
  u->value[5] = forces.tangential_force[0];
  u->value[6] = forces.tangential_force[1];
}

/* Puts the body down where the inputs are, with all springs free of stress. */
static void begin(unit *u) {
  const double *at = u->value + 1;
  @NAME@_start(&u->contact, at[0], at[1], at[2]);
  set_forces(u, @NAME@_step(&u->contact, NULL, at[0], at[1], at[2]));
  u->value[7] = 0;
}

static void set_start(unit *u) {
  memset(u, 0, sizeof *u);
  u->value[1] = @START@;
  begin(u);
}

text FMI(fmi3GetVersion)(void) { return "3.0"; }

void *FMI(fmi3InstantiateCoSimulation)(text name, text token, text resources, bool visible, bool logging,
    bool events, bool early, references required, size_t n, void *environment, void *log, void *update) {
  unit *u = strcmp(token, "@TOKEN@") == 0 && !events ? malloc(sizeof(unit)) : NULL;
  (void)name, (void)resources, (void)visible, (void)logging, (void)early, (void)required, (void)n;
  (void)environment, (void)log, (void)update;
  if (u) set_start(u);
  return u;
}
void FMI(fmi3FreeInstance)(void *u) { free(u); }
fmi3Status FMI(fmi3SetDebugLogging)(void *u, bool on, size_t n, const text *categories) {
  (void)u, (void)on, (void)n, (void)categories;
  return fmi3OK;
}

fmi3Status FMI(fmi3EnterInitializationMode)(void *u, bool tolerant, double tolerance, double start, bool stops,
    double stop) {
  (void)tolerant, (void)tolerance, (void)stops, (void)stop;
  ((unit *)u)->value[0] = start;
  return fmi3OK;
}
fmi3Status FMI(fmi3ExitInitializationMode)(void *u) {
  ((unit *)u)->running = true;
  return fmi3OK;
}
fmi3Status FMI(fmi3Terminate)(void *u) { (void)u; return fmi3OK; }
fmi3Status FMI(fmi3Reset)(void *u) { set_start(u); return fmi3OK; }

fmi3Status FMI(fmi3GetFloat64)(void *u, references which, size_t n, double *values, size_t size) {
  size_t i;
  if (n != size) return fmi3Error;
  for (i = 0; i < n; ++i) {
    if (which[i] >= variables) return fmi3Error;
    values[i] = ((unit *)u)->value[which[i]];
  }
  return fmi3OK;
}
fmi3Status FMI(fmi3SetFloat64)(void *u, references which, size_t n, const double *values, size_t size) {
  size_t i;
  if (n != size) return fmi3Error;
  for (i = 0; i < n; ++i)
    if (which[i] < 1 || which[i] > inputs || !isfinite(values[i])) return fmi3Error;
  for (i = 0; i < n; ++i) ((unit *)u)->value[which[i]] = values[i];
  if (!((unit *)u)->running) begin(u);
  return fmi3OK;
}

/* Moves the body in a straight line to the inputs. */
fmi3Status FMI(fmi3DoStep)(void *instance, double time, double size, bool final, bool *event, bool *terminate,
    bool *early, double *last) {
  unit *u = instance;
  const double *at = u->value + 1;
  const double travel_x = at[1] - u->contact.x, travel_y = at[2] - u->contact.y;
  const double before = u->value[5] * travel_x + u->value[6] * travel_y;
  (void)final;
  *event = *terminate = *early = false, *last = u->value[0];
  if (!u->running || !(size > 0)) return fmi3Error;
  set_forces(u, @NAME@_step(&u->contact, &u->contact, at[0], at[1], at[2]));
  u->value[7] += 0.5 * (before + u->value[5] * travel_x + u->value[6] * travel_y);
  *last = u->value[0] = time + size;
  return fmi3OK;
}

fmi3Status FMI(fmi3GetFMUState)(void *u, void **state) {
  if (!*state) *state = malloc(sizeof(unit));
  if (!*state) return fmi3Error;
  memcpy(*state, u, sizeof(unit));
  return fmi3OK;
}
fmi3Status FMI(fmi3SetFMUState)(void *u, void *state) {
  memcpy(u, state, sizeof(unit));
  return fmi3OK;
}
fmi3Status FMI(fmi3FreeFMUState)(void *u, void **state) {
  (void)u;
  free(*state);
  *state = NULL;
  return fmi3OK;
}
fmi3Status FMI(fmi3SerializedFMUStateSize)(void *u, void *state, size_t *size) {
  (void)u, (void)state;
  *size = sizeof(unit);
  return fmi3OK;
}
fmi3Status FMI(fmi3SerializeFMUState)(void *u, void *state, uint8_t *bytes, size_t size) {
  (void)u;
  if (size != sizeof(unit)) return fmi3Error;
  memcpy(bytes, state, size);
  return fmi3OK;
}
fmi3Status FMI(fmi3DeserializeFMUState)(void *u, const uint8_t *bytes, size_t size, void **state) {
  (void)u;
  if (size != sizeof(unit)) return fmi3Error;
  if (!*state) *state = malloc(size);
  if (!*state) return fmi3Error;
  memcpy(*state, bytes, size);
  return fmi3OK;
}

/* All variables are of the type Float64. */
#define NO_VARIABLES(name, type) \
  fmi3Status FMI(fmi3Get##name)(void *u, references r, size_t n, type *v, size_t m) { \
    (void)u, (void)r, (void)v, (void)m; return n == 0 ? fmi3OK : fmi3Error; } \
  fmi3Status FMI(fmi3Set##name)(void *u, references r, size_t n, const type *v, size_t m) { \
    (void)u, (void)r, (void)v, (void)m; return n == 0 ? fmi3OK : fmi3Error; }
NO_VARIABLES(Float32, float)
NO_VARIABLES(Int8, int8_t)
NO_VARIABLES(UInt8, uint8_t)
NO_VARIABLES(Int16, int16_t)
NO_VARIABLES(UInt16, uint16_t)
NO_VARIABLES(Int32, int32_t)
NO_VARIABLES(UInt32, uint32_t)
NO_VARIABLES(Int64, int64_t)
NO_VARIABLES(UInt64, uint64_t)
NO_VARIABLES(Boolean, bool)
NO_VARIABLES(String, text)

/* Functions of parts of the standard that this unit does not have. */
#define NOT_THERE(name, ...) \
  fmi3Status FMI(name)(__VA_ARGS__) { return fmi3Error; }
#define U void *u
#define R references r, size_t n
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif
void *FMI(fmi3InstantiateModelExchange)(text a, text b, text c, bool d, bool e, void *f, void *g) { return NULL; }
void *FMI(fmi3InstantiateScheduledExecution)(text a, text b, text c, bool d, bool e, void *f, void *g, void *h,
    void *i, void *j) { return NULL; }
NOT_THERE(fmi3GetBinary, U, R, size_t *s, const uint8_t **v, size_t m)
NOT_THERE(fmi3SetBinary, U, R, const size_t *s, const uint8_t *const *v, size_t m)
NOT_THERE(fmi3GetClock, U, R, bool *v)
NOT_THERE(fmi3SetClock, U, R, const bool *v)
NOT_THERE(fmi3EnterEventMode, U)
NOT_THERE(fmi3EnterStepMode, U)
NOT_THERE(fmi3EnterConfigurationMode, U)
NOT_THERE(fmi3ExitConfigurationMode, U)
NOT_THERE(fmi3EnterContinuousTimeMode, U)
NOT_THERE(fmi3EvaluateDiscreteStates, U)
NOT_THERE(fmi3UpdateDiscreteStates, U, bool *a, bool *b, bool *c, bool *d, bool *e, double *f)
NOT_THERE(fmi3GetNumberOfVariableDependencies, U, uint32_t v, size_t *n)
NOT_THERE(fmi3GetVariableDependencies, U, uint32_t v, size_t *a, uint32_t *b, size_t *c, int *d, size_t n)
NOT_THERE(fmi3GetDirectionalDerivative, U, R, references k, size_t m, const double *a, size_t b, double *c, size_t d)
NOT_THERE(fmi3GetAdjointDerivative, U, R, references k, size_t m, const double *a, size_t b, double *c, size_t d)
NOT_THERE(fmi3GetIntervalDecimal, U, R, double *a, int *q)
NOT_THERE(fmi3GetIntervalFraction, U, R, uint64_t *a, uint64_t *b, int *q)
NOT_THERE(fmi3GetShiftDecimal, U, R, double *a)
NOT_THERE(fmi3GetShiftFraction, U, R, uint64_t *a, uint64_t *b)
NOT_THERE(fmi3SetIntervalDecimal, U, R, const double *a)
NOT_THERE(fmi3SetIntervalFraction, U, R, const uint64_t *a, const uint64_t *b)
NOT_THERE(fmi3SetShiftDecimal, U, R, const double *a)
NOT_THERE(fmi3SetShiftFraction, U, R, const uint64_t *a, const uint64_t *b)
NOT_THERE(fmi3CompletedIntegratorStep, U, bool a, bool *b, bool *c)
NOT_THERE(fmi3SetTime, U, double t)
NOT_THERE(fmi3SetContinuousStates, U, const double *a, size_t n)
NOT_THERE(fmi3GetContinuousStateDerivatives, U, double *a, size_t n)
NOT_THERE(fmi3GetEventIndicators, U, double *a, size_t n)
NOT_THERE(fmi3GetContinuousStates, U, double *a, size_t n)
NOT_THERE(fmi3GetNominalsOfContinuousStates, U, double *a, size_t n)
NOT_THERE(fmi3GetNumberOfEventIndicators, U, size_t *n)
NOT_THERE(fmi3GetNumberOfContinuousStates, U, size_t *n)
NOT_THERE(fmi3GetOutputDerivatives, U, R, const int32_t *o, double *v, size_t m)
NOT_THERE(fmi3ActivateModelPartition, U, uint32_t r, double t)
)c";

constexpr std::string_view description = R"xml(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="@NAME@" instantiationToken="@TOKEN@" license="MIT-0"
  generationTool="salebra @VERSION@" variableNamingConvention="flat"
  description="Contact of rough surfaces with friction: forces over indentation and tangential displacement">
  <CoSimulation modelIdentifier="@NAME@" canHandleVariableCommunicationStepSize="true"
    canGetAndSetFMUState="true" canSerializeFMUState="true"/>
  <UnitDefinitions>
    <Unit name="s"><BaseUnit s="1"/></Unit>
@UNITS@  </UnitDefinitions>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent" variability="continuous" unit="s"/>
    <Float64 name="indentation" valueReference="1" causality="input" variability="continuous" unit="@LENGTH@" start="@START@"
      description="approach of the bodies, counted as sources/@NAME@.h says"/>
    <Float64 name="displacement_x" valueReference="2" causality="input" variability="continuous" unit="@LENGTH@" start="0"
      description="tangential displacement along x"/>
    <Float64 name="displacement_y" valueReference="3" causality="input" variability="continuous" unit="@LENGTH@" start="0"
      description="tangential displacement along y"/>
    <Float64 name="normal_force" valueReference="4" causality="output" variability="continuous" initial="calculated"
      unit="@FORCE@" description="normal force"/>
    <Float64 name="tangential_force_x" valueReference="5" causality="output" variability="continuous" initial="calculated"
      unit="@FORCE@" description="force along x that holds the displaced body"/>
    <Float64 name="tangential_force_y" valueReference="6" causality="output" variability="continuous" initial="calculated"
      unit="@FORCE@" description="force along y that holds the displaced body"/>
    <Float64 name="tangential_work" valueReference="7" causality="output" variability="continuous" initial="calculated"
      unit="@ENERGY@" description="work of the tangential forces since the start; over a closed cycle the energy dissipated"/>
  </ModelVariables>
  <ModelStructure>
    <Output valueReference="4"/>
    <Output valueReference="5"/>
    <Output valueReference="6"/>
    <Output valueReference="7"/>
    <InitialUnknown valueReference="4"/>
    <InitialUnknown valueReference="5"/>
    <InitialUnknown valueReference="6"/>
    <InitialUnknown valueReference="7"/>
  </ModelStructure>
</fmiModelDescription>
)xml";

constexpr std::string_view build = R"xml(<?xml version="1.0" encoding="UTF-8"?>
<fmiBuildDescription fmiVersion="3.0">
  <BuildConfiguration modelIdentifier="@NAME@">
    <SourceFileSet language="C99">
      <SourceFile name="@NAME@.c"/>
    </SourceFileSet>
    <Library name="m" external="true"/>
  </BuildConfiguration>
</fmiBuildDescription>
)xml";

/// The unit of a quantity, as FMI takes it: its name and its factors and exponents of SI units.
struct FmiUnit {
  std::string name, definition;
};

FmiUnit unit_of(const UnitSystem& units, Dimension dimension, std::string_view si_name,
                std::string_view exponents, const std::string& other_name) {
  const double factor = units.in_si(dimension);
  // 1 t mm/s² is 1 N but for the last bit of the factor.
  const bool si = std::abs(factor - 1) < 1e-12;
  FmiUnit unit{.name = si ? std::string(si_name) : other_name, .definition = {}};
  unit.definition = fmt::format("    <Unit name=\"{}\"><BaseUnit {}{}/></Unit>\n", unit.name,
                                exponents, si ? "" : fmt::format(" factor=\"{:.15g}\"", factor));
  return unit;
}

std::string filled(std::string_view pattern, const Deck& deck) {
  const DeckProblem& problem = deck.problem;
  const UnitSystem& units = problem.units;
  const FmiUnit length = unit_of(units, Dimension::length, "m", R"(m="1")", units.length);
  const FmiUnit force = unit_of(units, Dimension::force, "N", R"(kg="1" m="1" s="-2")",
                                fmt::format("{}.{}/{}2", units.mass, units.length, units.time));
  const FmiUnit energy = unit_of(units, Dimension::energy, "J", R"(kg="1" m="2" s="-2")",
                                 fmt::format("{}.{}2/{}2", units.mass, units.length, units.time));
  std::string text(pattern);
  replace_all(text, "@NAME@", problem.name);
  replace_all(text, "@VERSION@", version());
  replace_all(text, "@TOKEN@", Checksum(header_of_c(deck)).digits());
  replace_all(text, "@START@", fmt::format("{:.17g}", deck.start));
  replace_all(text, "@UNITS@", length.definition + force.definition + energy.definition);
  replace_all(text, "@LENGTH@", length.name);
  replace_all(text, "@FORCE@", force.name);
  replace_all(text, "@ENERGY@", energy.name);
  return text;
}

}  // namespace

std::string_view platform() {
#if defined(__linux__) && defined(__x86_64__)
  return "x86_64-linux";
#elif defined(__linux__) && defined(__aarch64__)
  return "aarch64-linux";
#else
  return "";
#endif
}

std::string fmu_library(const Deck& deck) {
  if (platform().empty() || found_on_path("cc").empty()) return "";
  const ScratchFolder folder("fmu");
  const std::string& name = deck.problem.name;
  const std::filesystem::path source = folder / (name + ".c"), library = folder / (name + ".so");
  std::ofstream(folder / (name + ".h")) << header_of_c(deck);
  std::ofstream(source) << filled(program, deck);
  const ChildRun run = run_child({"cc", "-std=c99", "-O2", "-fPIC", "-shared", "-o",
                                  library.string(), source.string(), "-lm"});
  if (run.start_error != 0 || run.signal != 0 || run.status != 0) return "";
  std::ifstream stream(library, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string fmu(const Deck& deck) {
  const std::string& name = deck.problem.name;
  std::vector<ZipMember> members{{"modelDescription.xml", filled(description, deck)},
                                 {"sources/buildDescription.xml", filled(build, deck)},
                                 {"sources/" + name + ".c", filled(program, deck)},
                                 {"sources/" + name + ".h", header_of_c(deck)}};
  if (!deck.library.empty())
    members.push_back({fmt::format("binaries/{}/{}.so", platform(), name), deck.library});
  return zip_archive(members);
}

}  // namespace salebra::detail
