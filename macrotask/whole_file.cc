#include "macrotask/whole_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace macrotask {
namespace {

[[noreturn]] void Fail(const std::string& path, int error,
                       const char* verb = "write") {
  throw std::runtime_error(std::string("cannot ") + verb + " '" + path +
                           "': " + std::generic_category().message(error));
}

namespace fs = std::filesystem;

// What is there already and is no file: a folder, which cannot be written, or a
// device or pipe, which must not be replaced.
bool IsSpecial(const std::string& path) {
  std::error_code unknown;  // as good as no file: opening it will say why
  const fs::file_status status = fs::status(path, unknown);
  if (fs::is_directory(status)) Fail(path, EISDIR);
  return fs::exists(status) && !fs::is_regular_file(status);
}

// The file itself, where the path is a link to it.
std::string Resolved(const std::string& path) {
  std::error_code unknown;
  return fs::is_symlink(path, unknown) ? fs::weakly_canonical(path).string()
                                       : path;
}

std::string TemporaryName(const std::string& path) {
  static std::atomic<unsigned> last{0};  // several tasks may write one file
  return path + ".tmp" + std::to_string(getpid()) + "-" +
         std::to_string(last.fetch_add(1, std::memory_order_relaxed));
}

void WriteTo(std::FILE* file, const std::string& path, std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() ||
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
        file_(std::fopen(name_.c_str(), "wxe")) {
    if (file_ == nullptr) Fail(path_, errno);
  }
  ~TemporaryFile() {
    if (file_ != nullptr) std::fclose(file_);
    if (!renamed_) std::remove(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void Write(std::string_view bytes) { WriteTo(file_, path_, bytes); }
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

void WriteWholeFile(const std::string& path, std::string_view bytes) {
  if (IsSpecial(path)) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        std::fopen(path.c_str(), "we"), &std::fclose);
    if (file == nullptr) Fail(path, errno);
    return WriteTo(file.get(), path, bytes);
  }
  TemporaryFile file(Resolved(path));
  file.Write(bytes);
  file.Rename();
}

void CheckWholeFile(const std::string& path) {
  if (!IsSpecial(path)) TemporaryFile file(Resolved(path));
}

std::string ReadWholeFile(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.c_str(), "re"), &std::fclose);
  if (file == nullptr) Fail(path, errno, "read");
  std::string bytes;
  char piece[1 << 16];
  while (const std::size_t count =
             std::fread(piece, 1, sizeof piece, file.get())) {
    bytes.append(piece, count);
  }
  if (std::ferror(file.get()) != 0) Fail(path, errno, "read");
  return bytes;
}

}  // namespace macrotask
