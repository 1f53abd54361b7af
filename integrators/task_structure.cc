#include "integrators/task_structure.h"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace integrators {
namespace {

constexpr std::array<std::pair<Figure, std::string_view>, 5> kNames = {{
    {Figure::kSerial, "serial"},
    {Figure::kFigure2, "figure2"},
    {Figure::kFigure3, "figure3"},
    {Figure::kFigure7, "figure7"},
    {Figure::kFigure8, "figure8"},
}};

void Require(bool possible, Figure figure, const std::string& expected) {
  if (possible) return;
  throw std::invalid_argument(std::string(Name(figure)) + " " + expected);
}

}  // namespace

std::string_view Name(Figure figure) {
  for (const auto& [value, name] : kNames) {
    if (value == figure) return name;
  }
  return "";
}

RmaSharing RmaSharingOf(Figure figure) {
  return figure == Figure::kFigure2 ? RmaSharing::kSerial
                                    : RmaSharing::kRedundant;
}

std::unique_ptr<TaskStructure> MakeTaskStructure(Figure figure,
                                                 Partition partition,
                                                 macrotask::WaitPolicy wait) {
  const auto [m, p] = partition;
  const std::string got = ": got " + std::to_string(m) + " chain tasks and " +
                          std::to_string(p) + " integration tasks";
  switch (figure) {
    case Figure::kSerial:
      Require(m == 1 && p == 1, figure, "has one task" + got);
      return MakeSerial();
    case Figure::kFigure2:
      Require(p == 1, figure, "is parallel over the chains only" + got);
      return MakeFigure2(m, wait);
    case Figure::kFigure3:
      Require(p == 1, figure, "is parallel over the chains only" + got);
      return MakeFigure3(m, wait);
    case Figure::kFigure7:
      Require(m == 1, figure, "is parallel over the block points only" + got);
      return MakeFigure7(p, wait);
    case Figure::kFigure8:
      break;
  }
  return MakeFigure8(partition, wait);
}

}  // namespace integrators
