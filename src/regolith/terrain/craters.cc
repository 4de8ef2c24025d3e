// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/craters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kVisibleDiameters = 100.0;  // distance from which a crater shows
constexpr double kReachRadii = kCraterReach * (1.0 + kCraterIrregularity);
constexpr double kProductionSlope = 3.0;  // 2.8 (Moore 1980) to 3.2 (Neukum 2001)

double Square(double value) { return value * value; }

// Depth / diameter of fresh craters (Stopar et al. 2017), relative to those of 30-100 m.
double RelativeDepth(double diameter) {
  struct Knot {
    double diameter;
    double depth;
  };
  constexpr Knot kKnots[] = {{1.0, 0.10}, {60.0, 0.12}, {150.0, 0.15}, {300.0, 0.17}, {450.0, 0.2}};
  constexpr double kReference = 0.12;
  if (diameter <= kKnots[0].diameter) return kKnots[0].depth / kReference;
  for (size_t i = 1; i < std::size(kKnots); ++i) {
    if (diameter > kKnots[i].diameter) continue;
    const double share = std::log(diameter / kKnots[i - 1].diameter) /
                         std::log(kKnots[i].diameter / kKnots[i - 1].diameter);
    return (kKnots[i - 1].depth + share * (kKnots[i].depth - kKnots[i - 1].depth)) / kReference;
  }
  return std::end(kKnots)[-1].depth / kReference;
}

// The share of its depth that a crater has left at a moment drawn from its visible life. Depth goes
// as exp(-(t/τ)^.58) (fitted to Fassett and Thomson 2014), and in the steady state all ages up to
// that of vanishing are equally frequent.
double DrawFreshness(double vanishing, Random* random) {
  constexpr double kPower = 0.58;
  const double age = random->Uniform() * std::pow(-std::log(vanishing), 1.0 / kPower);
  return std::exp(-std::pow(age, kPower));
}

double InverseDensity(const CraterOptions& options, double density) {
  const double knee = CraterDensity(options, options.equilibrium_diameter);
  if (density >= knee) return std::sqrt(options.density / density);
  return options.equilibrium_diameter * std::pow(knee / density, 1.0 / kProductionSlope);
}

// Craters of one cell of the plane with diameters in [low, high), drawn from the cell's own seed.
void DrawCell(const CraterOptions& options, uint64_t cell_seed, const Eigen::Vector2d& corner,
              double cell_size, double low, double high, std::vector<Crater>* craters) {
  Random random(cell_seed);
  const double wider = CraterDensity(options, high);
  const double density = CraterDensity(options, low) - wider;
  const int64_t count = random.Poisson(density * Square(cell_size));
  for (int64_t i = 0; i < count; ++i) {
    Crater crater;
    crater.centre = corner + cell_size * Eigen::Vector2d(random.Uniform(), random.Uniform());
    crater.diameter = InverseDensity(options, wider + random.Uniform() * density);
    const double fresh = FreshCraterDepth(options, crater.diameter);
    const double vanishing = std::clamp(options.oldest_depth / std::max(fresh, 1e-6), 0.01, 0.999);
    const double freshness = DrawFreshness(vanishing, &random);
    crater.freshness = static_cast<float>(freshness);
    crater.depth = static_cast<float>(freshness * fresh);
    // Amplitudes of cos 2θ and cos 3θ whose sum stays within the irregularity.
    const double second = random.Uniform(0.0, 0.6 * kCraterIrregularity);
    const double third = random.Uniform(0.0, 0.4 * kCraterIrregularity);
    const double phase = random.Uniform(0.0, 2.0 * M_PI);
    const double other_phase = random.Uniform(0.0, 2.0 * M_PI);
    crater.outline[0] = static_cast<float>(second * std::cos(phase));
    crater.outline[1] = static_cast<float>(second * std::sin(phase));
    crater.outline[2] = static_cast<float>(third * std::cos(other_phase));
    crater.outline[3] = static_cast<float>(third * std::sin(other_phase));
    craters->push_back(crater);
  }
}

std::vector<Crater> DrawClass(const CraterOptions& options, uint64_t seed, double low, double high,
                              const Eigen::AlignedBox2d& box) {
  const double cell_size = 8.0 * high;
  const double margin = 0.5 * kReachRadii * high;
  const auto cell = [&](double value) {
    return static_cast<int64_t>(std::floor(value / cell_size));
  };
  std::vector<Crater> craters;
  for (int64_t row = cell(box.min().y() - margin); row <= cell(box.max().y() + margin); ++row) {
    for (int64_t column = cell(box.min().x() - margin); column <= cell(box.max().x() + margin);
         ++column) {
      const uint64_t cell_seed =
          Scramble(Scramble(seed ^ static_cast<uint64_t>(column)) ^ static_cast<uint64_t>(row));
      const Eigen::Vector2d corner(static_cast<double>(column) * cell_size,
                                   static_cast<double>(row) * cell_size);
      DrawCell(options, cell_seed, corner, cell_size, low, high, &craters);
    }
  }
  // Cells reach beyond the box; what cannot matter to it is left out.
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(margin);
  const Eigen::AlignedBox2d around(box.min() - reach, box.max() + reach);
  craters.erase(
      std::remove_if(craters.begin(), craters.end(),
                     [&](const Crater& crater) { return !around.contains(crater.centre); }),
      craters.end());
  return craters;
}

// What a crater's shape needs, in single precision and in radii.
struct Shape {
  explicit Shape(const Crater& crater)
      : profile(&CraterProfiles()[static_cast<size_t>(CraterState(crater.freshness))]),
        outline{crater.outline[0], crater.outline[1], crater.outline[2], crater.outline[3]},
        scale(static_cast<float>(crater.diameter) * crater.depth) {}

  float Height(const CraterProfile& sampled, float x, float y) const {
    const float square = x * x + y * y + 1e-12F;
    const float inverse = 1.0F / std::sqrt(square);
    const float cosine = x * inverse;
    const float sine = y * inverse;
    const float cosine2 = cosine * cosine - sine * sine;
    const float sine2 = 2.0F * cosine * sine;
    const float cosine3 = cosine * cosine2 - sine * sine2;
    const float sine3 = sine * cosine2 + cosine * sine2;
    const float radius = 1.0F + outline[0] * cosine2 + outline[1] * sine2 + outline[2] * cosine3 +
                         outline[3] * sine3;
    return scale * ProfileHeight(sampled, square * inverse / radius);
  }

  const CraterProfile* profile;
  float outline[4];
  float scale;  // m
};

// In chunks beside the heights, so that the compiler sees no overlap and vectorises.
void AddRow(const Shape& shape, float x, float y, float step, int count, double* heights) {
  constexpr int kChunk = 64;
  const CraterProfile profile = *shape.profile;
  std::array<float, kChunk> chunk;
  for (int first = 0; first < count; first += kChunk) {
    const float start = x + static_cast<float>(first) * step;
    for (int i = 0; i < kChunk; ++i) {
      chunk[static_cast<size_t>(i)] =
          shape.Height(profile, start + static_cast<float>(i) * step, y);
    }
    const int size = std::min(kChunk, count - first);
    for (int i = 0; i < size; ++i) {
      heights[first + i] += static_cast<double>(chunk[static_cast<size_t>(i)]);
    }
  }
}

void AddCrater(const Crater& crater, const PostBlock& block, double* heights) {
  const Shape shape(crater);
  const double radius = 0.5 * crater.diameter;
  const double reach = kReachRadii * radius;
  const double x = block.x - crater.centre.x();
  const double y = block.y - crater.centre.y();
  const auto step = static_cast<float>(block.spacing / radius);
  const int last_row =
      std::min(block.rows - 1, static_cast<int>(std::floor((reach - y) / block.spacing)));
  for (int j = std::max(0, static_cast<int>(std::ceil((-reach - y) / block.spacing)));
       j <= last_row; ++j) {
    const double dy = y + j * block.spacing;
    const double half = std::sqrt(std::max(0.0, Square(reach) - Square(dy)));
    const int begin = std::max(0, static_cast<int>(std::ceil((-half - x) / block.spacing)));
    const int end =
        std::min(block.columns - 1, static_cast<int>(std::floor((half - x) / block.spacing)));
    const auto row_y = static_cast<float>(dy / radius);
    const auto row_x = static_cast<float>((x + begin * block.spacing) / radius);
    double* row = heights + static_cast<ptrdiff_t>(j) * block.columns + begin;
    AddRow(shape, row_x, row_y, step, end - begin + 1, row);
  }
}

}  // namespace

double CraterHeight(const Crater& crater, const Eigen::Vector2d& offset) {
  const Eigen::Vector2f radii = (offset / (0.5 * crater.diameter)).cast<float>();
  const Shape shape(crater);
  return static_cast<double>(shape.Height(*shape.profile, radii.x(), radii.y()));
}

double CraterDensity(const CraterOptions& options, double diameter) {
  const double knee = options.equilibrium_diameter;
  if (diameter <= knee) return options.density / Square(diameter);
  return options.density / Square(knee) * std::pow(knee / diameter, kProductionSlope);
}

double FreshCraterDepth(const CraterOptions& options, double diameter) {
  return options.fresh_depth * RelativeDepth(diameter);
}

CraterField::CraterField(const CraterOptions& options, uint64_t seed,
                         const Eigen::AlignedBox2d& box, double surroundings) {
  AddExtra(options);
  if (options.density <= 0.0) return;
  uint64_t index = 0;
  for (double low = options.min_diameter; low < options.max_diameter; low *= 2.0) {
    const double high = std::min(2.0 * low, options.max_diameter);
    const Eigen::Vector2d margin =
        Eigen::Vector2d::Constant(std::min(surroundings, kVisibleDiameters * high));
    const Eigen::AlignedBox2d around(box.min() - margin, box.max() + margin);
    const std::vector<Crater> craters =
        DrawClass(options, Scramble(seed + index++), low, high, around);
    size_ += craters.size();
    classes_.push_back(MakeClass(craters, high, around));
  }
}

void CraterField::AddExtra(const CraterOptions& options) {
  for (const ExtraCrater& extra : options.extra) {
    Crater crater;
    crater.centre = {extra.x, extra.y};
    crater.diameter = extra.diameter;
    crater.depth = static_cast<float>(extra.depth);
    const double fresh = std::max(FreshCraterDepth(options, extra.diameter), 1e-6);
    crater.freshness = static_cast<float>(std::min(1.0, extra.depth / fresh));
    const Eigen::AlignedBox2d around(crater.centre, crater.centre);
    classes_.push_back(MakeClass({crater}, extra.diameter, around));
    ++size_;
  }
}

CraterField::Class CraterField::MakeClass(const std::vector<Crater>& craters, double max_diameter,
                                          const Eigen::AlignedBox2d& box) {
  Class result;
  result.max_diameter = max_diameter;
  result.reach = 0.5 * kReachRadii * max_diameter;
  const double bin_size = 2.0 * result.reach;
  result.corner = box.min() - Eigen::Vector2d::Constant(result.reach);
  const Eigen::Vector2d size = box.sizes() / bin_size;
  result.columns = static_cast<int>(size.x()) + 2;
  result.rows = static_cast<int>(size.y()) + 2;
  std::vector<uint32_t> bins;
  result.starts.assign(static_cast<size_t>(result.columns) * static_cast<size_t>(result.rows) + 1,
                       0);
  for (const Crater& crater : craters) {
    const Eigen::Vector2d place = (crater.centre - result.corner) / bin_size;
    const int column = std::clamp(static_cast<int>(place.x()), 0, result.columns - 1);
    const int row = std::clamp(static_cast<int>(place.y()), 0, result.rows - 1);
    bins.push_back(static_cast<uint32_t>(row * result.columns + column));
    ++result.starts[bins.back() + 1];
  }
  for (size_t i = 1; i < result.starts.size(); ++i) result.starts[i] += result.starts[i - 1];
  std::vector<uint32_t> next(result.starts.begin(), result.starts.end() - 1);
  result.craters.resize(craters.size());
  for (size_t i = 0; i < craters.size(); ++i) result.craters[next[bins[i]]++] = craters[i];
  return result;
}

template <typename Visitor>
void CraterField::Visit(const Eigen::AlignedBox2d& box, double min_diameter,
                        const Visitor& visit) const {
  for (const Class& craters : classes_) {
    if (craters.max_diameter < min_diameter) continue;
    const Eigen::Vector2d low = box.min() - craters.corner;
    const Eigen::Vector2d high = box.max() - craters.corner;
    const auto bin = [&](double value, int count) {
      return static_cast<int>(
          std::clamp(std::floor(value / (2.0 * craters.reach)), -1.0, static_cast<double>(count)));
    };
    const int last_row = std::min(bin(high.y() + craters.reach, craters.rows), craters.rows - 1);
    const int first_column = std::max(bin(low.x() - craters.reach, craters.columns), 0);
    const int last_column =
        std::min(bin(high.x() + craters.reach, craters.columns), craters.columns - 1);
    for (int row = std::max(bin(low.y() - craters.reach, craters.rows), 0);
         row <= last_row && first_column <= last_column; ++row) {
      const auto line = static_cast<size_t>(row) * static_cast<size_t>(craters.columns);
      const uint32_t end = craters.starts[line + static_cast<size_t>(last_column) + 1];
      for (uint32_t i = craters.starts[line + static_cast<size_t>(first_column)]; i < end; ++i) {
        const Crater& crater = craters.craters[i];
        if (crater.diameter < min_diameter) continue;
        const double reach = 0.5 * kReachRadii * crater.diameter;
        if (box.squaredExteriorDistance(crater.centre) < Square(reach)) visit(crater);
      }
    }
  }
}

double CraterField::Height(double x, double y, double min_diameter) const {
  double height = 0.0;
  const Eigen::Vector2d place(x, y);
  Visit(Eigen::AlignedBox2d(place, place), min_diameter,
        [&](const Crater& crater) { height += CraterHeight(crater, place - crater.centre); });
  return height;
}

void CraterField::AddTo(const PostBlock& block, double min_diameter, double* heights) const {
  const Eigen::Vector2d low(block.x, block.y);
  const Eigen::Vector2d size(block.columns - 1, block.rows - 1);
  Visit(Eigen::AlignedBox2d(low, low + block.spacing * size), min_diameter,
        [&](const Crater& crater) { AddCrater(crater, block, heights); });
}

double CraterField::MeanDepth() const {
  double sum = 0.0;
  for (const Class& craters : classes_) {
    for (const Crater& crater : craters.craters) sum += static_cast<double>(crater.depth);
  }
  return size_ == 0 ? 0.0 : sum / static_cast<double>(size_);
}

double CraterField::Ejecta(double x, double y, double min_diameter) const {
  double sum = 0.0;
  const Eigen::Vector2d place(x, y);
  Visit(Eigen::AlignedBox2d(place, place), min_diameter, [&](const Crater& crater) {
    const double radii = 2.0 * (place - crater.centre).norm() / crater.diameter;
    // Inside, rocks are buried with the floor's fill; the rim's crest bares some.
    const double share = radii >= 1.0 ? std::pow(radii, -3.0) : 0.3 * std::pow(radii, 4.0);
    sum += std::pow(static_cast<double>(crater.freshness), 3.0) * share;
  });
  return sum;
}

}  // namespace regolith
