#include "integrators/block_method.h"

#include <charconv>
#include <stdexcept>
#include <utility>

namespace integrators {
namespace {

// Solves A x = b by elimination, exactly.
std::vector<Rational> Solve(std::vector<std::vector<Rational>> A,
                            std::vector<Rational> b) {
  const std::size_t n = b.size();
  for (std::size_t col = 0; col < n; ++col) {
    std::size_t pivot = col;
    while (A[pivot][col] == Rational(0)) ++pivot;
    std::swap(A[pivot], A[col]);
    std::swap(b[pivot], b[col]);
    for (std::size_t row = 0; row < n; ++row) {
      if (row == col) continue;
      const Rational factor = A[row][col] / A[col][col];
      for (std::size_t j = col; j < n; ++j) {
        A[row][j] = A[row][j] - factor * A[col][j];
      }
      b[row] = b[row] - factor * b[col];
    }
  }
  for (std::size_t i = 0; i < n; ++i) b[i] = b[i] / A[i][i];
  return b;
}

// Weights of all points of a block whose newest derivative is at `newest`.
std::vector<std::vector<Rational>> BlockWeights(int block_size, int num_values,
                                                int newest) {
  std::vector<int> offsets;
  for (int j = 0; j < num_values; ++j) {
    offsets.push_back(newest - num_values + 1 + j);
  }
  std::vector<std::vector<Rational>> weights;
  for (int i = 1; i <= block_size; ++i) {
    weights.push_back(IntegrationWeights(offsets, i));
  }
  return weights;
}

[[noreturn]] void RejectName(std::string_view name) {
  throw std::invalid_argument(
      "unknown method '" + std::string(name) +
      "': expected B1PC5, B2PC5, B4PC5, or another B<b>PC<k> with k > b");
}

// Reads the digits at the front of `text` and removes them.
bool TakeNumber(std::string_view* text, int* number) {
  const auto [end, error] =
      std::from_chars(text->data(), text->data() + text->size(), *number);
  if (error != std::errc() || *number < 1) return false;
  text->remove_prefix(static_cast<std::size_t>(end - text->data()));
  return true;
}

}  // namespace

std::vector<Rational> IntegrationWeights(const std::vector<int>& offsets,
                                         int end) {
  const std::size_t k = offsets.size();
  std::vector<std::vector<Rational>> powers(k, std::vector<Rational>(k));
  std::vector<Rational> integrals(k);
  Rational end_power = end;
  for (std::size_t d = 0; d < k; ++d) {
    for (std::size_t j = 0; j < k; ++j) {
      powers[d][j] = d == 0 ? Rational(1) : powers[d - 1][j] * offsets[j];
    }
    integrals[d] = end_power / static_cast<std::int64_t>(d + 1);
    end_power = end_power * end;
  }
  return Solve(std::move(powers), std::move(integrals));
}

std::string BlockMethod::name() const {
  std::string name = "B";
  return name.append(std::to_string(block_size))
      .append("PC")
      .append(std::to_string(num_values));
}

BlockMethod MakeBlockMethod(int block_size, int num_values) {
  if (block_size < 1 || num_values < 2 || num_values <= block_size) {
    throw std::invalid_argument(
        "no method B" + std::to_string(block_size) + "PC" +
        std::to_string(num_values) +
        ": expected at least one point and more values than points");
  }
  return {.block_size = block_size,
          .num_values = num_values,
          .predictor = BlockWeights(block_size, num_values, 0),
          .corrector = BlockWeights(block_size, num_values, block_size)};
}

BlockMethod B1PC5() { return MakeBlockMethod(1, 5); }
BlockMethod B2PC5() { return MakeBlockMethod(2, 5); }
BlockMethod B4PC5() { return MakeBlockMethod(4, 5); }

BlockMethod ParseBlockMethod(std::string_view name) {
  std::string_view rest = name;
  int block_size = 0, num_values = 0;
  if (!rest.starts_with('B')) RejectName(name);
  rest.remove_prefix(1);
  if (!TakeNumber(&rest, &block_size) || !rest.starts_with("PC")) {
    RejectName(name);
  }
  rest.remove_prefix(2);
  if (!TakeNumber(&rest, &num_values) || !rest.empty() ||
      num_values <= block_size) {
    RejectName(name);
  }
  try {
    constexpr int kTooMany = 100;  // whose weights overflow in any case
    if (num_values < kTooMany) return MakeBlockMethod(block_size, num_values);
  } catch (const std::overflow_error&) {
  }
  throw std::invalid_argument("method '" + std::string(name) +
                              "': its coefficients do not fit 64-bit "
                              "fractions");
}

}  // namespace integrators
