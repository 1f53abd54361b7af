#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

// The program as its users see it: what it prints, where, its exit code, and
// what files it leaves. PROGRAM is its path.

namespace bench {

namespace fs = std::filesystem;

inline std::string ReadAll(const fs::path& path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

struct Outcome {
  int exit_code;
  std::string out, error;
};

// Runs the program in a folder of its own, which does not outlive the test.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest()
      : folder_(fs::path(testing::TempDir()) /
                ("program_test" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    Run("--version");  // creates out and error
  }
  ~ProgramTest() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return folder_ / name; }

  std::ptrdiff_t NumFiles() const {
    return std::distance(fs::directory_iterator(folder_), {});
  }

  // `before` is what the shell is to do with the program, as "taskset -c 0 ".
  Outcome Run(const std::string& arguments, const std::string& before = "") {
    const std::string command = "cd '" + folder_.string() + "' && " + before +
                                "'" PROGRAM "' " + arguments +
                                " >out 2>error </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadAll(Path("out")),
            ReadAll(Path("error"))};
  }

  // One sentence on the standard error, nothing else, exit code 2, no file.
  void ExpectRejected(const std::string& arguments,
                      const std::string& sentence) {
    const auto before = NumFiles();
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(outcome.error, "macrotask: " + sentence + "\n") << arguments;
    EXPECT_EQ(NumFiles(), before) << arguments;
  }

 private:
  const fs::path folder_;
};

}  // namespace bench
