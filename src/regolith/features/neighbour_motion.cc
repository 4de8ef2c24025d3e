// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/neighbour_motion.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace regolith {
namespace {

constexpr size_t kMinMatches = 8;
constexpr size_t kMinNeighbours = 4;
// Of the gradient, in pixels squared: neighbours spread over less than this say nothing about it.
constexpr double kGradientPrior = 100.0;
constexpr int kGlobalRounds = 6;
constexpr int kLocalRounds = 2;

/// A match as a place and how far it moves from there.
struct Displacement {
  Eigen::Vector2d place;
  Eigen::Vector2d motion;
  size_t row = 0;
};

/// motion(place) = offset + gradient (place - centre)
struct AffineMotion {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();

  Eigen::Vector2d At(const Eigen::Vector2d& place) const {
    return offset + gradient * (place - centre);
  }
};

/// The lower of the middle ones; reorders. Few values, as neighbours are, are sorted by exchanges
/// that need no branch (std::nth_element: a third more time for the whole test).
double Median(std::vector<double>* values) {
  const size_t size = values->size();
  const size_t middle = (size - 1) / 2;
  if (size > 16) {
    std::nth_element(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(middle),
                     values->end());
  } else {
    double* data = values->data();
    for (size_t end = size; end > 1; --end) {
      for (size_t i = 1; i < end; ++i) {
        const double low = std::min(data[i - 1], data[i]);
        data[i] = std::max(data[i - 1], data[i]);
        data[i - 1] = low;
      }
    }
  }
  return (*values)[middle];
}

template <typename Value>
double MedianOf(const std::vector<Displacement>& motions, std::vector<double>* scratch,
                const Value& value) {
  scratch->clear();
  for (const Displacement& motion : motions) scratch->push_back(value(motion));
  return Median(scratch);
}

/// Least squares with Cauchy's weights, from the median motion on. `floor` (pixels) is the least
/// scale of the residuals.
AffineMotion FitAffine(const std::vector<Displacement>& motions, const Eigen::Vector2d& centre,
                       int rounds, double floor, std::vector<double>* scratch) {
  AffineMotion fit;
  fit.centre = centre;
  for (int axis = 0; axis < 2; ++axis) {
    fit.offset[axis] =
        MedianOf(motions, scratch, [&](const Displacement& m) { return m.motion[axis]; });
  }
  for (int round = 0; round < rounds; ++round) {
    const auto residual = [&](const Displacement& m) {
      return (m.motion - fit.At(m.place)).norm();
    };
    const double scale = std::max(floor, 1.5 * MedianOf(motions, scratch, residual));
    Eigen::Matrix3d normal = Eigen::Vector3d(1e-9, kGradientPrior, kGradientPrior).asDiagonal();
    Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
    for (const Displacement& motion : motions) {
      const double relative = residual(motion) / scale;
      const double weight = 1.0 / (1.0 + relative * relative);
      const Eigen::Vector3d terms(1.0, motion.place.x() - centre.x(),
                                  motion.place.y() - centre.y());
      normal += weight * terms * terms.transpose();
      right += weight * terms * motion.motion.transpose();
    }
    const Eigen::Matrix<double, 3, 2> solution = normal.inverse() * right;
    fit.offset = solution.row(0).transpose();
    fit.gradient = solution.bottomRows<2>().transpose();
  }
  return fit;
}

/// Finds the nearest in order of x, from the place asked for outwards on both sides.
class NearestInOrder {
 public:
  explicit NearestInOrder(std::vector<Displacement> motions) : motions_(std::move(motions)) {
    std::sort(motions_.begin(), motions_.end(), [](const Displacement& a, const Displacement& b) {
      return a.place.x() != b.place.x() ? a.place.x() < b.place.x() : a.row < b.row;
    });
  }

  /// The `count` nearest to `query` but itself.
  void Find(const Displacement& query, size_t count, std::vector<Displacement>* nearest) {
    heap_.clear();
    size_t right = static_cast<size_t>(
        std::lower_bound(motions_.begin(), motions_.end(), query.place.x(),
                         [](const Displacement& m, double x) { return m.place.x() < x; }) -
        motions_.begin());
    size_t left = right;
    while (left > 0 || right < motions_.size()) {
      const double to_left = left > 0 ? query.place.x() - motions_[left - 1].place.x() : INFINITY;
      const double to_right =
          right < motions_.size() ? motions_[right].place.x() - query.place.x() : INFINITY;
      const double gap = std::min(to_left, to_right);
      if (heap_.size() == count && gap * gap > heap_.front().square_distance) break;
      Offer(query, to_left < to_right ? --left : right++, count);
    }
    nearest->clear();
    for (const Candidate& candidate : heap_) nearest->push_back(motions_[candidate.index]);
  }

 private:
  struct Candidate {
    double square_distance;
    size_t index;
    bool operator<(const Candidate& other) const {
      return square_distance != other.square_distance ? square_distance < other.square_distance
                                                      : index < other.index;
    }
  };

  void Offer(const Displacement& query, size_t index, size_t count) {
    if (motions_[index].row == query.row) return;
    const Candidate candidate{(motions_[index].place - query.place).squaredNorm(), index};
    if (heap_.size() == count) {
      if (!(candidate < heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  std::vector<Displacement> motions_;
  std::vector<Candidate> heap_;  ///< furthest first
};

/// What neighbours make expect of a place: its motion beyond what all have in common, and how far
/// (pixels) a true match may be from that.
struct Expectation {
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();
  double tolerance = 0.0;
};

Expectation ExpectMotion(const std::vector<Displacement>& neighbours, const Eigen::Vector2d& place,
                         const OutlierRejectionOptions& options, std::vector<double>* scratch) {
  const AffineMotion local =
      FitAffine(neighbours, place, kLocalRounds, 0.5 * options.neighbour_pixels, scratch);
  // The median decides what the fit, of which the slope alone is used, may have spread.
  Expectation expected;
  const auto motion_here = [&](const Displacement& m) -> Eigen::Vector2d {
    return m.motion - local.gradient * (m.place - place);
  };
  for (int axis = 0; axis < 2; ++axis) {
    expected.motion[axis] =
        MedianOf(neighbours, scratch, [&](const Displacement& m) { return motion_here(m)[axis]; });
  }
  const double spread = MedianOf(neighbours, scratch, [&](const Displacement& m) {
    return (motion_here(m) - expected.motion).norm();
  });
  expected.tolerance = options.neighbour_pixels + options.neighbour_spread * spread;
  return expected;
}

/// Whether `motion` is what its neighbours make expect.
bool AgreesWith(const std::vector<Displacement>& neighbours, const Displacement& motion,
                const OutlierRejectionOptions& options, std::vector<double>* scratch) {
  if (neighbours.size() < kMinNeighbours) return true;
  const Expectation expected = ExpectMotion(neighbours, motion.place, options, scratch);
  return (motion.motion - expected.motion).norm() <= expected.tolerance;
}

std::vector<Displacement> InlierMotions(const std::vector<Eigen::Vector2f>& first,
                                        const std::vector<Eigen::Vector2f>& second,
                                        const std::vector<uint8_t>& inliers) {
  std::vector<Displacement> motions;
  for (size_t row = 0; row < first.size(); ++row) {
    if (!inliers[row]) continue;
    motions.push_back({first[row].cast<double>(), (second[row] - first[row]).cast<double>(), row});
  }
  return motions;
}

/// What all motions have in common; leaves what is beyond it. Neighbours far apart show rotation
/// and zoom poorly; all matches together show them well.
AffineMotion TakeCommon(const OutlierRejectionOptions& options, std::vector<double>* scratch,
                        std::vector<Displacement>* motions) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const Displacement& motion : *motions) centre += motion.place;
  centre /= static_cast<double>(motions->size());
  const AffineMotion common =
      FitAffine(*motions, centre, kGlobalRounds, options.neighbour_pixels, scratch);
  for (Displacement& motion : *motions) motion.motion -= common.At(motion.place);
  return common;
}

}  // namespace

void RejectAgainstNeighbours(const std::vector<Eigen::Vector2f>& first,
                             const std::vector<Eigen::Vector2f>& second,
                             const OutlierRejectionOptions& options,
                             std::vector<uint8_t>* inliers) {
  std::vector<Displacement> candidates = InlierMotions(first, second, *inliers);
  if (options.neighbours == 0 || candidates.size() < kMinMatches) return;
  std::vector<double> scratch;
  TakeCommon(options, &scratch, &candidates);

  // The first pass has outliers among the neighbours; the second judges again, without them, those
  // who had.
  std::vector<Displacement> neighbours;
  std::vector<size_t> neighbour_rows;  // of the first pass, for all candidates
  std::vector<size_t> neighbour_ends;
  NearestInOrder all(candidates);
  for (const Displacement& candidate : candidates) {
    all.Find(candidate, static_cast<size_t>(options.neighbours), &neighbours);
    for (const Displacement& neighbour : neighbours) neighbour_rows.push_back(neighbour.row);
    neighbour_ends.push_back(neighbour_rows.size());
    (*inliers)[candidate.row] = AgreesWith(neighbours, candidate, options, &scratch);
  }
  std::vector<Displacement> trusted;
  for (const Displacement& candidate : candidates) {
    if ((*inliers)[candidate.row]) trusted.push_back(candidate);
  }
  NearestInOrder nearest(std::move(trusted));
  const std::vector<uint8_t> first_verdict = *inliers;
  size_t begin = 0;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const auto from = neighbour_rows.begin() + static_cast<std::ptrdiff_t>(begin);
    begin = neighbour_ends[i];
    const auto to = neighbour_rows.begin() + static_cast<std::ptrdiff_t>(begin);
    if (std::all_of(from, to, [&](size_t row) { return first_verdict[row] != 0; })) continue;
    nearest.Find(candidates[i], static_cast<size_t>(options.neighbours), &neighbours);
    (*inliers)[candidates[i].row] = AgreesWith(neighbours, candidates[i], options, &scratch);
  }
}

bool PredictFromNeighbours(const std::vector<Eigen::Vector2f>& first,
                           const std::vector<Eigen::Vector2f>& second,
                           const std::vector<uint8_t>& inliers,
                           const std::vector<Eigen::Vector2f>& places,
                           const OutlierRejectionOptions& options, MatchGuide* guide) {
  std::vector<Displacement> motions = InlierMotions(first, second, inliers);
  if (options.neighbours == 0 || motions.size() < kMinMatches) return false;
  std::vector<double> scratch;
  const AffineMotion common = TakeCommon(options, &scratch, &motions);
  NearestInOrder nearest(std::move(motions));
  std::vector<Displacement> neighbours;
  guide->predicted.clear();
  guide->radii.clear();
  for (const Eigen::Vector2f& pixel : places) {
    const Eigen::Vector2d place = pixel.cast<double>();
    nearest.Find({place, Eigen::Vector2d::Zero(), SIZE_MAX},
                 static_cast<size_t>(options.neighbours), &neighbours);
    const Expectation expected = ExpectMotion(neighbours, place, options, &scratch);
    guide->predicted.push_back((place + common.At(place) + expected.motion).cast<float>());
    guide->radii.push_back(static_cast<float>(expected.tolerance));
  }
  return true;
}

}  // namespace regolith
