#include "bench/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace bench {
namespace {

[[noreturn]] void Fail(const std::string& path, int error) {
  throw std::runtime_error("cannot write '" + path +
                           "': " + std::generic_category().message(error));
}

std::string TemporaryName(const std::string& path) {
  return path + ".tmp" + std::to_string(getpid());
}

// A file that vanishes unless it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& path)
      : path_(path),
        name_(TemporaryName(path)),
        file_(std::fopen(name_.c_str(), "wx")) {
    if (file_ == nullptr) Fail(path_, errno);
  }
  ~TemporaryFile() {
    if (file_ != nullptr) std::fclose(file_);
    if (!renamed_) std::remove(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void Write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) {
      Fail(path_, errno);
    }
  }
  void Rename() {
    std::FILE* file = std::exchange(file_, nullptr);
    if (std::fclose(file) != 0) Fail(path_, errno);
    if (std::rename(name_.c_str(), path_.c_str()) != 0) Fail(path_, errno);
    renamed_ = true;
  }

 private:
  std::string path_, name_;
  std::FILE* file_;
  bool renamed_ = false;
};

}  // namespace

void WriteOutput(const std::string& path, const std::string& text) {
  if (path == "-") {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
        std::fflush(stdout) != 0) {
      Fail("standard output", errno);
    }
    return;
  }
  TemporaryFile file(path);
  file.Write(text);
  file.Rename();
}

void CheckOutput(const std::string& path) {
  if (path.empty()) throw std::runtime_error("the output file has no name");
  if (path != "-") TemporaryFile file(path);
}

}  // namespace bench
