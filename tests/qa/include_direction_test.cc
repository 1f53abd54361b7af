// Includes point one way: tests, bench -> integrators -> macrotask and
// tests, bench -> dynamics. Quoted includes are written from the root.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// What a folder may include besides itself: folders of the house, and of
// libraries the first directory in <Eigen/Dense>. The system's are free.
struct Rule {
  Names folders;
  Names libraries;
};

const std::map<std::string, Rule>& Rules() {
  static const auto* kRules = new std::map<std::string, Rule>{
      {"macrotask", {{}, {"boost"}}},
      {"dynamics", {{}, {"Eigen"}}},
      {"integrators", {{"macrotask"}, {}}},
      {"bench",
       {{"macrotask", "dynamics", "integrators"},
        {"CLI", "Eigen", "fmt", "nlohmann"}}},
      {"tests",
       {{"macrotask", "dynamics", "integrators", "bench"},
        {"Eigen", "fmt", "gmock", "gtest", "nlohmann"}}},
  };
  return *kRules;
}

const Names kSystem = {"arpa", "bits",    "experimental", "linux",
                       "net",  "netinet", "sanitizer",    "sys"};

bool ExistsBelowRoot(const std::string& file) {
  const fs::path path = fs::path(SOURCE_DIR) / file;
  return fs::exists(path) || fs::exists(path.string() + ".in");  // Generated.
}

std::string CheckQuoted(const std::string& folder, const std::string& file) {
  const std::string target = file.substr(0, file.find('/'));
  if (!Rules().contains(target) || file.find("..") != std::string::npos) {
    return "is not written from the root";
  }
  if (target != folder && !Rules().at(folder).folders.contains(target)) {
    return "points the wrong way";
  }
  return ExistsBelowRoot(file) ? "" : "names no file";
}

std::string CheckAngled(const std::string& folder, const std::string& file) {
  const size_t slash = file.find('/');
  const std::string target = file.substr(0, slash);
  if (slash == std::string::npos || kSystem.contains(target)) return "";
  if (Rules().contains(target)) return "needs quotation marks";
  return Rules().at(folder).libraries.contains(target)
             ? ""
             : "is a library that this folder does without";
}

// One complaint for each bad include in the text of a file of `folder`.
std::vector<std::string> CheckIncludes(const std::string& folder,
                                       const std::string& text) {
  static const std::regex kInclude(
      R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  std::vector<std::string> complaints;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    const std::string complaint = match[1] == "\""
                                      ? CheckQuoted(folder, match[2])
                                      : CheckAngled(folder, match[2]);
    if (!complaint.empty())
      complaints.push_back(line.append(": ").append(complaint));
  }
  return complaints;
}

std::string ReadFile(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

bool IsSource(const fs::path& path) {
  const fs::path extension = path.extension();
  return extension == ".h" || extension == ".cc" || extension == ".c";
}

class IncludeDirection : public testing::TestWithParam<const char*> {};

TEST_P(IncludeDirection, HoldsInEveryFile) {
  const std::string folder = GetParam();
  const fs::path root = SOURCE_DIR;
  int num_files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
    ++num_files;
    for (const auto& complaint :
         CheckIncludes(folder, ReadFile(entry.path()))) {
      ADD_FAILURE() << fs::relative(entry.path(), root).string() << ": "
                    << complaint;
    }
  }
  EXPECT_GT(num_files, 0);
}

INSTANTIATE_TEST_SUITE_P(Folders, IncludeDirection,
                         testing::Values("macrotask", "dynamics", "integrators",
                                         "bench", "tests"),
                         [](const auto& folder) { return folder.param; });

struct Planted {
  const char* folder;
  const char* line;
  bool is_good;
};

TEST(CheckIncludes, FindsEachPlantedLine) {
  const Planted all[] = {
      {"macrotask", "#include \"macrotask/barrier.h\"", true},
      {"macrotask", "#include <pthread.h>", true},
      {"macrotask", "#include <sys/resource.h>", true},
      {"macrotask", "  #  include \"dynamics/arm.h\"  // why", false},
      {"macrotask", "#include \"integrators/plan.h\"", false},
      {"macrotask", "#include <Eigen/Dense>", false},
      {"macrotask", "#include \"barrier.h\"", false},
      {"macrotask", "#include \"../macrotask/barrier.h\"", false},
      {"macrotask", "#include \"macrotask/../macrotask/barrier.h\"", false},
      {"macrotask", "#include <macrotask/barrier.h>", false},
      {"macrotask", "#include \"macrotask/no_such_file.h\"", false},
      {"dynamics", "#include <Eigen/Dense>", true},
      {"dynamics", "#include \"macrotask/barrier.h\"", false},
      {"dynamics", "#include \"integrators/plan.h\"", false},
      {"dynamics", "#include \"bench/build_info.h\"", false},
      {"integrators", "#include \"macrotask/barrier.h\"", true},
      {"integrators", "#include \"dynamics/arm.h\"", false},
      {"integrators", "#include \"tests/support/kkt.h\"", false},
      {"bench", "#include \"macrotask/barrier.h\"", true},
      {"bench", "#include \"bench/build_info.h\"", true},
      {"bench", "#include \"tests/support/kkt.h\"", false},
      {"tests", "#include \"bench/build_info.h\"", true},
      {"bench", "// #include \"tests/support/kkt.h\"", true},
  };
  for (const Planted& planted : all) {
    const std::string text = std::string("int x;\n") + planted.line + "\n";
    EXPECT_EQ(CheckIncludes(planted.folder, text).empty(), planted.is_good)
        << planted.folder << ": " << planted.line;
  }
}

}  // namespace
