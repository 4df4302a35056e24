// SPDX-License-Identifier: BSD-3-Clause
// ode_ext-run: starts a program with the preload, and says why where it cannot work.
#include <dlfcn.h>
#include <fcntl.h>
#include <getopt.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>

#include "preload/core.h"
#include "tools/run/elf_program.h"

namespace {

// As of env and nohup.
enum ExitCode { kExitUsage = 2, kExitFailed = 125, kExitCannotRun = 126, kExitNotFound = 127 };

constexpr const char* kUsage =
    "usage: ode_ext-run [options] program [arguments]\n"
    "Runs a program that uses the Open Dynamics Engine with its mesh pairs collided by ode_ext.\n"
    "\n"
    "  --stats             say at the end what was collided, and what it took\n"
    "  --device DEVICE     platform:type:name, or a number from ode_ext-info\n"
    "  --max-contacts N    contacts kept per pair, 1 to 64 (16)\n"
    "  --trust-meshes      meshes change only through ODE's functions: saves comparing them\n"
    "  --config TEXT       as dBatchColliderParams.config\n"
    "  --log LEVEL         off, error, warning (default) or info\n"
    "  --trace FILE        write a time line of every pass, for Perfetto\n"
    "  --capture FILE      write what is collided, for ode_ext-replay\n"
    "  --help, --version\n"
    "\n"
    "Each option sets a variable of the environment, which may be set instead: ODE_EXT_STATS=1,\n"
    "ODE_EXT_DEVICE, ODE_EXT_MAX_CONTACTS, ODE_EXT_TRUST_MESHES=1, ODE_EXT_CONFIG, ODE_EXT_LOG,\n"
    "ODE_EXT_TRACE, ODE_EXT_CAPTURE. The program's ODE may be a shared library, of its own or of\n"
    "the system, or on x86-64 be linked into it and exported.\n"
    "Exit status: that of the program; 2 wrong usage, 125 ode_ext is not installed completely,\n"
    "126 the program cannot be run like this, 127 it is not found.\n";

struct Setting {
  const char* option;
  const char* variable;
  const char* value;  // null: the option's argument
};
constexpr Setting kSettings[] = {
    {"stats", "ODE_EXT_STATS", "1"},
    {"device", "ODE_EXT_DEVICE", nullptr},
    {"max-contacts", "ODE_EXT_MAX_CONTACTS", nullptr},
    {"trust-meshes", "ODE_EXT_TRUST_MESHES", "1"},
    {"config", "ODE_EXT_CONFIG", nullptr},
    {"log", "ODE_EXT_LOG", nullptr},
    {"trace", "ODE_EXT_TRACE", nullptr},
    {"capture", "ODE_EXT_CAPTURE", nullptr},
};
constexpr int kSettingCount = std::size(kSettings);
constexpr int kHelp = kSettingCount, kVersion = kSettingCount + 1;

[[noreturn]] void fail(ExitCode code, const std::string& message) {
  std::cerr << "ode_ext-run: " << message << '\n';
  std::exit(code);
}

// Beside this program: an installed tree can be moved.
std::string preload_library() {
  std::error_code error;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) fail(kExitFailed, "/proc/self/exe: " + error.message());
  const auto library =
      (own.parent_path() / ODE_EXT_BIN_TO_PRELOAD / "libode_ext_preload.so").lexically_normal();
  if (access(library.c_str(), R_OK) != 0)
    fail(kExitFailed, library.string() + ": " + std::strerror(errno));
  if (library.string().find_first_of(" :") != std::string::npos)
    fail(kExitFailed, "LD_PRELOAD cannot hold a path with a space or a colon: " + library.string());
  return library;
}

bool is_whole_number(const std::string& text, long least, long most) {
  char* end = nullptr;
  const long number = std::strtol(text.c_str(), &end, 10);
  return std::isdigit(static_cast<unsigned char>(text[0])) != 0 && *end == '\0' &&
         number >= least && number <= most;
}

// Why a program could not write there, or "". Makes no file: a program without meshes writes none.
std::string why_not_written(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return std::strerror(EISDIR);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const bool is_there = access(path.c_str(), F_OK) == 0;
  const std::string& place = is_there ? path : folder.empty() ? "." : folder;
  if (access(place.c_str(), W_OK) != 0) return std::strerror(errno);
  return !is_there && !std::filesystem::is_directory(place, error) ? std::strerror(ENOTDIR) : "";
}

// What the library says of a config, or ""; so too where it cannot be loaded, which the program
// says once it wants it.
std::string fault_of_config(const std::string& config, const std::filesystem::path& preload) {
  const auto library = preload.parent_path() / "libode_ext_preload_double.so";
  void* loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* check = loaded == nullptr ? nullptr : dlsym(loaded, "ode_ext_preload_config_fault");
  if (check == nullptr) return "";
  const char* fault = reinterpret_cast<dxPreloadConfigFaultFn*>(check)(config.c_str());
  return fault == nullptr ? "" : fault;
}

// A program whose environment says what the library refuses goes on without the library; what an
// option says is refused here, before the program starts.
void check_option(const std::string& option, const std::string& value) {
  std::string fault;
  if (option == "max-contacts" && !is_whole_number(value, 1, 64)) {
    fault = "expected a whole number from 1 to 64";
  } else if (option == "log" && value != "off" && value != "error" && value != "warning" &&
             value != "info") {
    fault = "expected off, error, warning or info";
  } else if (option == "trace" || option == "capture") {
    fault = value.empty() ? "expected a file" : why_not_written(value);
  } else if (option == "config") {
    fault = fault_of_config(value, preload_library());
  }
  if (!fault.empty()) fail(kExitUsage, "--" + option + " '" + value + "': " + fault);
}

// Sets what the options say; returns the index of the program in argv.
int read_options(int argc, char** argv) {
  option options[kSettingCount + 3] = {};
  for (int i = 0; i < kSettingCount; ++i)
    options[i] = {kSettings[i].option,
                  kSettings[i].value == nullptr ? required_argument : no_argument, nullptr, i};
  options[kHelp] = {"help", no_argument, nullptr, kHelp};
  options[kVersion] = {"version", no_argument, nullptr, kVersion};
  // "+": what follows the program is the program's.
  for (int chosen; (chosen = getopt_long(argc, argv, "+h", options, nullptr)) != -1;) {
    if (chosen == kHelp || chosen == 'h') {
      std::cout << kUsage;
      std::exit(EXIT_SUCCESS);
    }
    if (chosen == kVersion) {
      std::cout << "ode_ext " ODE_EXT_VERSION "\n";
      std::exit(EXIT_SUCCESS);
    }
    if (chosen == '?') std::exit(kExitUsage);  // getopt has said what is wrong
    const Setting& setting = kSettings[chosen];
    if (setting.value == nullptr) check_option(setting.option, optarg);
    setenv(setting.variable, setting.value == nullptr ? optarg : setting.value, 1);
  }
  if (optind == argc) {
    std::cerr << kUsage;
    std::string after;
    for (int i = 1; i < argc; ++i) after += std::string(" ") + argv[i];
    fail(kExitUsage, "no program is named" + (after.empty() ? "" : " after" + after));
  }
  return optind;
}

bool is_executable_file(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         access(path.c_str(), X_OK) == 0;
}

std::string path_of(const std::string& program) {
  if (program.find('/') != std::string::npos) {
    if (access(program.c_str(), F_OK) != 0)
      fail(kExitNotFound, program + ": " + std::strerror(errno));
    if (!is_executable_file(program)) fail(kExitCannotRun, program + " is not an executable file");
    return program;
  }
  const char* variable = std::getenv("PATH");
  const std::string path = variable == nullptr ? "/usr/bin:/bin" : variable;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find(':', begin), path.size());
    const std::string directory = path.substr(begin, end - begin);
    std::string candidate = (directory.empty() ? "." : directory) + "/" + program;
    if (is_executable_file(candidate)) return candidate;
    begin = end + 1;
  }
  fail(kExitNotFound, program + " is not found in PATH");
}

}  // namespace

int main(int argc, char** argv) {
  char** command = argv + read_options(argc, argv);
  const std::string program = path_of(*command);
  const std::string obstacle = ode_ext::why_not_preloaded(program);
  if (!obstacle.empty()) fail(kExitCannotRun, program + " " + obstacle);

  std::string preload = preload_library();
  const char* others = std::getenv("LD_PRELOAD");
  if (others != nullptr && *others != '\0') preload += std::string(":") + others;
  setenv("LD_PRELOAD", preload.c_str(), 1);
  setenv("ODE_EXT_STATS_OF", std::to_string(getpid()).c_str(), 1);  // which exec keeps
  execv(program.c_str(), command);
  fail(kExitCannotRun, program + ": " + std::strerror(errno));
}
