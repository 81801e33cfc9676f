// SPDX-License-Identifier: GPL-3.0-or-later
// Runs commands that write while chosen system calls fail, and judges what they leave: old or
// complete files, a true exit status.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fault_library.hpp"

using namespace salebra::faults;
namespace fs = std::filesystem;

namespace {

/// Names to contents of the files in a folder and below.
using Files = std::map<std::string, std::string>;

struct Case {
  std::string name;
  std::vector<std::string>
      inputs;           ///< commands that make what the command reads, run in the folder of inputs
  std::string command;  ///< IN stands for the folder of inputs
  std::string first = {};  ///< a command whose files lie there already
  std::string after = {};  ///< run without faults after a failure; then all files must be complete
};

const std::string random_surface =
    "generate --points 32 --size-x 1um --method random-phase --hurst 0.8 --rolloff 0.5um "
    "--short-cutoff 250nm --rms-height 10nm --seed ";
const std::string surface = random_surface + "1", other = random_surface + "2";
const std::string material = " --contact-modulus 1GPa --poisson 0.3";
const std::string moves = " --normal-amplitude 1nm --drag-velocity 1mm/s --frequency 20kHz";
const std::string curve = "contact IN/s.h5 --pressure 1:30MPa:6 --stiffness" + material;
const std::string oscillation =
    "oscillate --shape cylinder --points 16 --steps 8 --intervals 4 --friction 0.3 "
    "--max-periods 2" +
    material;

const std::string small_study = R"([surface]
points = 32
size_x = "1um"
hurst = 0.8
rolloff = "0.5um"
short_cutoff = "250nm"
rms_height = "10nm"
method = "random-phase"
seeds = [1, 2]
[material]
contact_modulus = "1GPa"
poisson = 0.3
[contact]
pressures = ["5MPa", "10MPa", "20MPa", "40MPa", "80MPa"]
[damping]
mode = "drag"
normal_amplitude = "0.01nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
)";

std::vector<Case> all_cases() {
  const std::vector<std::string> in{surface + " -o s.h5"};
  const std::string study = "study IN/small.toml -o out.h5";
  std::vector<Case> cases{
      {"generate", {}, surface + " -o out.h5"},
      {"generate_again", {}, surface + " -o out.h5 --overwrite", other + " -o out.h5"},
      {"pair", in, "convert IN/s.h5 out.npy"},
      {"pair_again", in, "convert IN/s.h5 out.npy --overwrite", other + " -o out.npy"},
      {"profile",
       {},
       "generate --profile --points 64 --size-x 1um --hurst 0.8 --rolloff 0.5um "
       "--short-cutoff 125nm --method random-phase --rms-height 10nm -o out.csv"},
      {"contact", in, "contact IN/s.h5 --pressure 5MPa -o out.h5" + material},
      {"contact_checkpoint", in,
       "contact IN/s.h5 --pressure 5MPa -o out.h5 --checkpoint out.state --checkpoint-every 0" +
           material},
      // Several megabytes, which go to the disk while the file is made.
      {"contact_large",
       {"generate --points 384 --size-x 1um --method random-phase --hurst 0.8 --rolloff 0.5um "
        "--short-cutoff 250nm --rms-height 10nm -o s.h5"},
       "contact IN/s.h5 --pressure 5MPa --tolerance 1e-3 -o out.h5" + material},
      {"contact_curve", in, curve + " -o out.h5"},
      {"contact_cycle", in,
       "contact IN/s.h5 --mean-gap 60:30nm:4 --cycle --work-of-adhesion 10mJ/m2 --adhesion-range "
       "10nm -o out.h5" +
           material},
      {"contact_curve_table", in, curve + " -o out.csv"},
      {"contact_summits",
       {},
       "contact --model gw_moments --summit-density 10/um2 --radius 100nm --summit-rms 10nm "
       "--mean-gap 10nm,20nm,40nm "
       "-o out.h5" +
           material},
      {"fit", {in[0], curve + " -o curve.h5"}, "fit IN/curve.h5 -o out.h5"},
      {"statistics", in, "statistics IN/s.h5 -o out.h5"},
      {"statistics_tables", in, "statistics IN/s.h5 -o out.csv"},
      {"damping",
       {},
       "damping --law exponential --decay-length 10nm --normal-force 1N -o out.h5" + moves +
           material},
      {"indenter",
       {},
       "damping --law sphere --radius 1mm --indentation 1um --mode equal-frequency "
       "--normal-amplitude 0.1um --tangential-amplitude 0.1um --phase 90deg --frequency "
       "1kHz --map-phases 8 --map-radii 8 --stress-map out.h5" +
           material},
      {"oscillate", {}, oscillation + " -o out.h5"},
      {"oscillate_checkpoint",
       {},
       oscillation + " -o out.h5 --checkpoint out.state --checkpoint-every 0"},
      {"damper",
       {},
       "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--normal-amplitude 10nm,20nm --frequency 20kHz,30kHz -o out.h5"},
      {"sliding",
       {},
       "sliding --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --normal-amplitude 10nm --frequency 20kHz --velocities "
       "1um/s,1mm/s -o out.h5"},
      {"slider",
       {},
       "sliding --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --mass 1kg --spring-stiffness 1MN/m --velocities 1mm/s "
       "--support-damping 300 -o out.csv"},
      {"joint",
       {},
       "joint --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --tangential-forces 10mN,100mN -o out.csv"},
      {"viscoelastic",
       {},
       "viscoelastic --law cone --angle 10deg --indentation 1um --prony 1GPa:1ms "
       "--normal-amplitude 0.1um --drag-velocity 1um/s --frequency 100 --steps 32 --springs 16 -o "
       "out.csv" +
           material},
      {"shapes", {}, "oscillate --shape cylinder,cone --points 16 --steps 8 -o out.h5" + material},
      // Resumable from the start: the file holds its command line.
      {"study", {}, study + " --no-report --resume", {}, study + " --no-report --resume"},
      {"study_page", {}, study + " --resume", {}, study + " --resume"},
      {"shard", {}, study + " --shard any", {}, study + " --shard any"},
      {"merge",
       {},
       study + " --no-report --merge",
       study + " --shard any",
       study + " --no-report --merge"},
      {"compare", {}, "compare IN/small.toml -o out.h5 --no-report"},
      {"report", {"study small.toml -o study.h5 --no-report"}, "report IN/study.h5 -o out.html"},
      {"init", {}, "init out.toml"},
      {"twin_init", in, "twin init out.toml --files IN/s.h5"},
      {"export",
       {},
       "export --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --to c-header -o out.h"},
      {"completion", {}, "completion bash -o out.bash"},
      {"plot", in, "statistics IN/s.h5 --plot out.svg"},
      {"plot_sliding",
       {},
       "sliding --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --normal-amplitude 10nm --frequency 20kHz --velocities "
       "1um/s,1mm/s --plot out.svg"},
      {"plot_damping",
       {},
       "damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--normal-amplitude 1nm,2nm --drag-velocity 1um/s --frequency 20kHz --plot out.svg"}};
  for (const char* format : {"h5", "gwy", "gsf", "xyz", "txt"})
    cases.push_back({std::string("convert_") + format,
                     {surface + " -o s.npy"},
                     std::string("convert IN/s.npy out.") + format});
  return cases;
}

/// What is done to one call, or from one call on.
struct Fault {
  Kind kind;
  long call;
  bool for_good;
  int error;
};

std::string describe(const Fault& fault) {
  std::ostringstream text;
  text << kind_names[std::size_t(fault.kind)] << ' ' << fault.call
       << (fault.for_good ? " and all after it: " : ": ")
       << (fault.error == short_write ? "half of it"
           : fault.error == killed    ? "killed before it"
                                      : strerrorname_np(fault.error));
  return text.str();
}

/// The ways in which a kind of call may fail: error, whether for good.
std::vector<std::pair<int, bool>> failures_of(Kind kind) {
  switch (kind) {
    case Kind::write:
      return {
          {EIO, false}, {ENOSPC, true}, {EINTR, false}, {short_write, false}, {short_write, true}};
    case Kind::sync:
    case Kind::space:
    case Kind::close:
    case Kind::open:
      return {{EIO, false}, {ENOSPC, true}, {EINTR, false}};
    case Kind::rename:
      return {{EIO, false}, {ENOSPC, true}};
    case Kind::read:
      return {{EIO, false}, {EIO, true}, {EINTR, false}};
    case Kind::memory:
      return {{ENOMEM, false}, {ENOMEM, true}};
  }
  return {};
}

/// POSIX has these repeated, or gone on with, by who calls.
bool must_survive(const Fault& fault) { return fault.error == short_write || fault.error == EINTR; }

long lines_with(const std::string& text, const std::string& beginning) {
  std::istringstream lines(text);
  long count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with(beginning);
  return count;
}

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = content(entry.path());
  return files;
}

void put(const Files& files, const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directory(folder);
  for (const auto& [name, text] : files) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
}

struct Outcome {
  int status = 0;  ///< minus the signal that ended it
  std::string errors;
};

class Bench {
 public:
  Bench(std::string program, std::string library)
      : program_(std::move(program)), library_(std::move(library)) {
    // In memory where there is such a place for this user: what is tested here is not the disk.
    const fs::path parent =
        access("/dev/shm", W_OK) == 0 ? fs::path("/dev/shm") : fs::temp_directory_path();
    std::string name = (parent / "salebra-faults-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    root_ = name;
    fs::create_directory(inputs());
    std::ofstream(inputs() / "small.toml") << small_study;
    const int file = open((root_ / "plan").c_str(), O_RDWR | O_CREAT, 0600);
    if (file < 0 || ftruncate(file, sizeof(Plan)) != 0) throw std::runtime_error("no plan");
    void* mapped = mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (mapped == MAP_FAILED) throw std::runtime_error("no plan");
    plan_ = new (mapped) Plan;
    std::strncpy(plan_->folder.data(), folder().c_str(), plan_->folder.size() - 1);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  ~Bench() {
    munmap(plan_, sizeof(Plan));
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }

  fs::path folder() const { return root_ / "out"; }
  fs::path inputs() const { return root_ / "in"; }
  const Plan& plan() const { return *plan_; }

  Outcome run(const std::string& command, const fs::path& where, const Fault* fault) {
    plan_->kind = fault ? fault->kind : Kind::write;
    plan_->first = fault ? fault->call : 0;
    plan_->for_good = fault && fault->for_good;
    plan_->error = fault ? fault->error : 0;
    for (auto& count : plan_->calls) count = 0;
    plan_->failed = 0;
    const pid_t child = fork();
    if (child == 0) execute(command, where);
    int raw = 0;
    waitpid(child, &raw, 0);
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -WTERMSIG(raw), content(root_ / "errors")};
  }

 private:
  [[noreturn]] void execute(const std::string& command, const fs::path& where) const {
    std::vector<std::string> words{"salebra"};
    std::istringstream stream(command);
    for (std::string word; stream >> word;)
      words.push_back(word.starts_with("IN/") ? (inputs() / word.substr(3)).string() : word);
    words.insert(words.end(), {"--threads", "1", "--quiet"});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int errors = open((root_ / "errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    setenv("LD_PRELOAD", library_.c_str(), 1);
    setenv("SALEBRA_FAULTS", (root_ / "plan").c_str(), 1);
    setenv("OMP_NUM_THREADS", "1", 1);
    setenv("OMP_WAIT_POLICY", "passive", 1);  // else the program starts itself anew to set it
    alarm(60);                                // what takes longer hangs
    if (chdir(where.c_str()) == 0) execv(program_.c_str(), arguments.data());
    _exit(97);
  }

  std::string program_, library_;
  fs::path root_;
  Plan* plan_ = nullptr;
};

struct Tally {
  long faults = 0, survived = 0, refused = 0, violations = 0;
  void operator+=(const Tally& more) {
    faults += more.faults;
    survived += more.survived;
    refused += more.refused;
    violations += more.violations;
  }
};

class CaseRun {
 public:
  CaseRun(Bench& bench, const Case& of) : bench_(bench), case_(of) {}

  /// Why the case cannot be run here; empty where it can.
  std::string prepare() {
    for (const std::string& input : case_.inputs)
      if (const Outcome made = bench_.run(input + " --overwrite", bench_.inputs(), nullptr);
          made.status != 0)
        throw std::runtime_error(case_.name + ": " + input + ": " + made.errors);
    put({}, bench_.folder());
    if (!case_.first.empty()) bench_.run(case_.first, bench_.folder(), nullptr);
    before_ = files_in(bench_.folder());
    const Outcome whole = bench_.run(case_.command, bench_.folder(), nullptr);
    if (whole.errors.find("not installed") != std::string::npos ||
        whole.errors.find("does not contain plotly.js") != std::string::npos)
      return "needs what is not installed";
    if (whole.status != 0) throw std::runtime_error(case_.name + ": " + whole.errors);
    after_ = files_in(bench_.folder());
    for (std::size_t kind = 0; kind < kinds; ++kind) calls_[kind] = bench_.plan().calls[kind];
    put(before_, bench_.folder());
    bench_.run(case_.command, bench_.folder(), nullptr);
    if (files_in(bench_.folder()) != after_)
      throw std::runtime_error(case_.name + ": two runs without a fault write different files");
    return "";
  }

  /// A kill between the writing of each file and its rename.
  std::vector<Fault> kills() const {
    std::vector<Fault> all;
    for (long call = 1; call <= calls_[std::size_t(Kind::rename)]; ++call)
      all.push_back({Kind::rename, call, false, killed});
    return all;
  }

  /// Chooses at most about so many of all possible faults, evenly.
  std::vector<Fault> faults(long most, bool of_memory) const {
    std::vector<Fault> all;
    for (std::size_t k = 0; k < kinds; ++k) {
      const auto kind = static_cast<Kind>(k);
      if ((kind == Kind::memory) != of_memory) continue;
      for (long call = 1; call <= calls_[k]; ++call)
        for (const auto& [error, for_good] : failures_of(kind))
          all.push_back({kind, call, for_good, error});
    }
    if (long(all.size()) <= most) return all;
    std::vector<Fault> some;
    for (long i = 0; i < most; ++i)
      some.push_back(all[std::size_t(i) * all.size() / std::size_t(most)]);
    return some;
  }

  Tally judge(const std::vector<Fault>& faults) {
    Tally tally;
    for (const Fault& fault : faults) {
      put(before_, bench_.folder());
      const Outcome outcome = bench_.run(case_.command, bench_.folder(), &fault);
      const std::string wrong = judge(fault, outcome);
      ++tally.faults;
      ++(outcome.status == 0 ? tally.survived : tally.refused);
      if (wrong.empty()) continue;
      ++tally.violations;
      std::printf("VIOLATION %s: %s: %s; status %d: %s\n", case_.name.c_str(),
                  describe(fault).c_str(), wrong.c_str(), outcome.status, outcome.errors.c_str());
    }
    return tally;
  }

 private:
  std::string judge(const Fault& fault, const Outcome& outcome) {
    const bool is_kill = fault.error == killed;
    if (outcome.status < 0 && !is_kill) return "ended by a signal";
    if (outcome.status != -SIGKILL && is_kill) return "survived a kill";
    if (bench_.plan().failed == 0 && outcome.status != 0) return "failed without a fault";
    if (must_survive(fault) && outcome.status != 0) return "is to be survived";
    const Files now = files_in(bench_.folder());
    for (const auto& [name, text] : now) {
      const std::string file = fs::path(name).filename().string();
      const bool temporary = file.ends_with(".part") || file.starts_with("lock.");
      // Where an allocation fails while another failure is handled, the process ends at once
      // (docs/reliability.md).
      if (temporary && (fault.kind == Kind::memory || is_kill)) continue;
      if (temporary) return name + " was left";
      // What --resume, a shard and a merge go on with: they take over locks and claims of a process
      // that is gone.
      if (file.ends_with(".realisation") || is_claim(file) || file.starts_with("shard.") ||
          file == "lock" || file == "out.state")
        continue;
      const auto old = before_.find(name), complete = after_.find(name);
      const bool is_old = old != before_.end() && old->second == text;
      const bool is_complete = complete != after_.end() && complete->second == text;
      if (!is_old && !is_complete) return name + " is neither old nor complete";
    }
    for (const auto& [name, text] : before_)
      if (!now.contains(name) && after_.contains(name)) return name + " is gone";
    if (outcome.status == 0) return without_locks(now) == after_ ? "" : "is called done and is not";
    if (is_kill) return torn_pair(now) + resumed();
    if (outcome.status != 1) return "has another status than 1";
    const long errors = lines_with(outcome.errors, "salebra: error: "),
               warnings = lines_with(outcome.errors, "salebra: warning: ");
    if (errors != 1 || errors + warnings != std::ranges::count(outcome.errors, '\n'))
      return "does not say so in one line";
    return torn_pair(now) + resumed();
  }

  /// An array of one generation beside the sidecar of the other must not be readable.
  std::string torn_pair(const Files& now) {
    const auto is_new = [&](const char* name) {
      return now.contains(name) && now.at(name) == after_.at(name);
    };
    if (!now.contains("out.npy") || is_new("out.npy") == is_new("out.npy.json")) return "";
    const Outcome read = bench_.run("statistics out.npy", bench_.folder(), nullptr);
    return read.status == 2 ? "" : "leaves halves of two pairs, which are read together";
  }

  std::string resumed() {
    if (case_.after.empty()) return "";
    const Outcome again = bench_.run(case_.after, bench_.folder(), nullptr);
    if (again.status != 0) return "cannot be resumed: " + again.errors;
    return without_locks(files_in(bench_.folder())) == after_ ? ""
                                                              : "is another result once resumed";
  }

  /// Finished, or not yet linked.
  static bool is_claim(const std::string& file) { return file.find(".claim") != std::string::npos; }

  /// A lock whose file could not be read is left, and the next process takes it over. That of a
  /// shard is left until the merge, and so is a file that a shard began, which another may be
  /// writing.
  Files without_locks(Files now) const {
    now.erase("out.h5.parts/lock");
    std::erase_if(now, [&](const auto& file) {
      return file.first.starts_with("out.h5.parts/shard.") || is_claim(file.first) ||
             (case_.name == "shard" && file.first.ends_with(".part"));
    });
    return now;
  }

  Bench& bench_;
  const Case& case_;
  Files before_, after_;
  std::array<long, kinds> calls_{};
};

long number(const char* text) {
  long value = 0;
  const auto [end, status] = std::from_chars(text, text + std::strlen(text), value);
  if (status != std::errc{} || *end != '\0')
    throw std::runtime_error(std::string(text) + ": no number");
  return value;
}

int run(int argc, char** argv) {
  if (argc < 6)
    throw std::runtime_error(
        "usage: faults PROGRAM LIBRARY CALLS ALLOCATIONS CASE...; CASE may be all");
  const std::vector<std::string> wanted(argv + 5, argv + argc);
  const std::vector<Case> cases = all_cases();
  for (const std::string& name : wanted)
    if (name != "all" && std::ranges::find(cases, name, &Case::name) == cases.end())
      throw std::runtime_error(name + ": no case");
  Tally total;
  std::printf("%-20s %8s %8s %10s %10s\n", "case", "faults", "survived", "refused", "violations");
  for (const Case& one : cases) {
    if (wanted.front() != "all" && std::ranges::find(wanted, one.name) == wanted.end()) continue;
    Bench bench(argv[1], argv[2]);
    CaseRun test(bench, one);
    if (const std::string missing = test.prepare(); !missing.empty()) {
      std::printf("%-20s %s\n", one.name.c_str(), missing.c_str());
      continue;
    }
    Tally tally = test.judge(test.faults(number(argv[3]), false));
    tally += test.judge(test.faults(number(argv[4]), true));
    if (number(argv[3]) > 0) tally += test.judge(test.kills());
    std::printf("%-20s %8ld %8ld %10ld %10ld\n", one.name.c_str(), tally.faults, tally.survived,
                tally.refused, tally.violations);
    std::fflush(stdout);
    total += tally;
  }
  std::printf("%-20s %8ld %8ld %10ld %10ld\n", "all", total.faults, total.survived, total.refused,
              total.violations);
  return total.faults > 0 && total.violations == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "faults: %s\n", error.what());
    return 1;
  }
}
