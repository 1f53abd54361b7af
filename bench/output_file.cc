#include "bench/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
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

namespace fs = std::filesystem;

// What is there already and is no file: a folder, which cannot be written, or a
// device or pipe, which must not be replaced.
bool IsSpecial(const std::string& path) {
  const fs::file_status status = fs::status(path);
  if (fs::is_directory(status)) Fail(path, EISDIR);
  return fs::exists(status) && !fs::is_regular_file(status);
}

// The file itself, where the path is a link to it.
std::string Resolved(const std::string& path) {
  return fs::is_symlink(path) ? fs::weakly_canonical(path).string() : path;
}

std::string TemporaryName(const std::string& path) {
  return path + ".tmp" + std::to_string(getpid());
}

void WriteTo(std::FILE* file, const std::string& path,
             const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() ||
      std::fflush(file) != 0) {
    Fail(path, errno);
  }
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

  void Write(const std::string& text) { WriteTo(file_, path_, text); }
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
  if (path == "-") return WriteTo(stdout, "standard output", text);
  if (IsSpecial(path)) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) Fail(path, errno);
    WriteTo(file, path, text);
    std::fclose(file);
    return;
  }
  TemporaryFile file(Resolved(path));
  file.Write(text);
  file.Rename();
}

void CheckOutput(const std::string& path) {
  if (path.empty()) throw std::runtime_error("the output file has no name");
  if (path != "-" && !IsSpecial(path)) TemporaryFile file(Resolved(path));
}

}  // namespace bench
