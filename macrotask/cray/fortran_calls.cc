// The symbols that gfortran calls: lower case with an underscore, everything by
// reference, the lengths of CHARACTER arguments by value behind all others.
// Compiled twice: for default integers of 4 bytes and, for programs of which
// -fdefault-integer-8 is the rule, of 8.

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#define MACROTASK_NO_MACROS
#include "macrotask/cray.h"
#include "macrotask/cray/call.h"
#include "macrotask/cray/objects.h"
#include "macrotask/cray/printing.h"
#include "macrotask/cray/tasks.h"
#include "macrotask/cray/tuning.h"
#include "macrotask/task.h"
#include "macrotask/trace.h"

#ifndef MACROTASK_FORTRAN_INTEGER
#error "MACROTASK_FORTRAN_INTEGER must be std::int32_t or std::int64_t"
#endif

namespace macrotask::cray {

using Word = MACROTASK_FORTRAN_INTEGER;
using Logical = Word;  // INTEGER and LOGICAL have the same size

#define MACROTASK_NAME(UPPER, lower) lower##_
#include "macrotask/cray/calls-inl.h"

// For the generic names of the module, whose `value` may be absent.
MACROTASK_ENTRY void macrotask_lockasgn_(Word* lock, const Word* value) {
  RunCall(MACROTASK_CALL("LOCKASGN"), [&] {
    if (value == nullptr) {
      AssignLock(lock);
    } else {
      AssignLockIf(lock, *value);
    }
  });
}

MACROTASK_ENTRY void macrotask_evasgn_(Word* event, const Word* value) {
  RunCall(MACROTASK_CALL("EVASGN"), [&] {
    if (value == nullptr) {
      AssignEvent(event);
    } else {
      AssignEventIf(event, *value);
    }
  });
}

MACROTASK_ENTRY void barasgn_(Word* barrier, const Word* num_tasks) {
  RunCall(MACROTASK_CALL("BARASGN"),
          [&] { AssignBarrier(barrier, *num_tasks); });
}

MACROTASK_ENTRY void tsklist_() { PrintTaskList(); }

namespace {

constexpr std::size_t kMostPairs = 8;

// Addresses of keywords and values, in turn, up to what is no address: a null
// pointer, or the length of a CHARACTER argument, which is never as large as
// the lowest address that a process can have.
constexpr std::uintptr_t kLowestAddress = 4096;

std::size_t NumPairs(const std::uintptr_t* words, std::size_t most) {
  std::size_t num_pairs = 0;
  while (num_pairs < most && words[2 * num_pairs] >= kLowestAddress) {
    if (words[2 * num_pairs + 1] < kLowestAddress) {
      throw std::runtime_error("keyword " + std::to_string(num_pairs + 1) +
                               " has no value");
    }
    ++num_pairs;
  }
  return num_pairs;
}

// The lengths of the keywords are behind all keywords and values.
std::vector<TuningPair> PairsOf(const std::uintptr_t* words,
                                std::size_t num_pairs,
                                const std::uintptr_t* lengths) {
  std::vector<TuningPair> pairs;
  for (std::size_t i = 0; i < num_pairs; ++i) {
    const auto* keyword = reinterpret_cast<const char*>(words[2 * i]);
    const auto* value = reinterpret_cast<const Word*>(words[2 * i + 1]);
    pairs.push_back({std::string(keyword, lengths[i]), *value});
  }
  return pairs;
}

}  // namespace

MACROTASK_ENTRY MACROTASK_LOOKS_AT_MORE_WORDS void tsktune_(const char* keyword,
                                                            const Word* value,
                                                            ...) {
  // One pair more, to see whether the list ends.
  std::uintptr_t words[3 * (kMostPairs + 1)] = {
      reinterpret_cast<std::uintptr_t>(keyword),
      reinterpret_cast<std::uintptr_t>(value)};
  va_list rest;
  va_start(rest, value);
  for (std::size_t i = 2; i < std::size(words); ++i) {
    words[i] = va_arg(rest, std::uintptr_t);
  }
  va_end(rest);
  RunCall(MACROTASK_CALL("TSKTUNE"), [&] {
    const std::size_t num_pairs = NumPairs(words, kMostPairs + 1);
    if (num_pairs > kMostPairs) {
      throw std::runtime_error("more than " + std::to_string(kMostPairs) +
                               " pairs");
    }
    Tune(PairsOf(words, num_pairs, words + 2 * num_pairs));
  });
}

// For the module: always six pairs, of which all but the first may be absent.
MACROTASK_ENTRY void macrotask_tsktune_(
    const char* keyword_1, const Word* value_1, const char* keyword_2,
    const Word* value_2, const char* keyword_3, const Word* value_3,
    const char* keyword_4, const Word* value_4, const char* keyword_5,
    const Word* value_5, const char* keyword_6, const Word* value_6,
    std::size_t length_1, std::size_t length_2, std::size_t length_3,
    std::size_t length_4, std::size_t length_5, std::size_t length_6) {
  const auto word = [](const void* address) {
    return reinterpret_cast<std::uintptr_t>(address);
  };
  const std::uintptr_t words[] = {
      word(keyword_1), word(value_1), word(keyword_2), word(value_2),
      word(keyword_3), word(value_3), word(keyword_4), word(value_4),
      word(keyword_5), word(value_5), word(keyword_6), word(value_6)};
  const std::uintptr_t lengths[] = {length_1, length_2, length_3,
                                    length_4, length_5, length_6};
  RunCall(MACROTASK_CALL("TSKTUNE"), [&] {
    Tune(PairsOf(words, NumPairs(words, std::size(lengths)), lengths));
  });
}

MACROTASK_ENTRY void buftune_(const char* keyword, const char* value,
                              std::size_t keyword_length,
                              std::size_t value_length) {
  RunCall(MACROTASK_CALL("BUFTUNE"), [&] {
    TuneTrace({keyword, keyword_length}, {value, value_length});
  });
}

MACROTASK_ENTRY void bufuser_(const Word* action, const Word* data) {
  RunCall(MACROTASK_CALL("BUFUSER"), [&] {
    RecordUser(*action, static_cast<std::uint64_t>(std::int64_t{*data}));
  });
}

MACROTASK_ENTRY void bufprint_() {
  RunCall(MACROTASK_CALL("BUFPRINT"), [] { PrintTrace(); });
}

MACROTASK_ENTRY void bufdump_() {
  RunCall(MACROTASK_CALL("BUFDUMP"), [] { DumpTrace(); });
}

// The type of the function is that of the caller's default REAL, which is taken
// to be as long as its INTEGER: a program of 8-byte words has
// -fdefault-real-8 as well.
using Real = std::conditional_t<sizeof(Word) == 8, double, float>;
MACROTASK_ENTRY Real tsecnd_() { return static_cast<Real>(CpuSeconds()); }

// For the module: always double precision.
MACROTASK_ENTRY double macrotask_tsecnd_() { return CpuSeconds(); }

MACROTASK_ENTRY void mttimes_() { PrintBusyTimes(); }

}  // namespace macrotask::cray
