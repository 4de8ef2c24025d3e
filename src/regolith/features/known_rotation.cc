// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/known_rotation.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "regolith/core/random.h"

namespace regolith {
namespace {

// A lucky pair may gather nearly all matches and still be degrees off; some more cost little.
constexpr int kMinIterations = 50;
constexpr int kRefinements = 3;
constexpr int kFinalRefinements = 10;

/// A match and its parallax. The translation t lies in the plane of both bearings: normal . t = 0.
struct Parallax {
  Eigen::Vector3d first;
  Eigen::Vector3d second;
  Eigen::Vector3d normal;  ///< first x second
};

Parallax MakeParallax(const RotatedBearings& bearings, size_t index) {
  const Eigen::Vector3d& first = bearings.first[index];
  const Eigen::Vector3d& second = bearings.second[index];
  return {first, second, first.cross(second)};
}

/// Whether both bearings are the same within the threshold.
bool IsWithout(const Parallax& match, double threshold) {
  return match.normal.squaredNorm() <= threshold * threshold && match.first.dot(match.second) > 0.0;
}

/// Square of the sine between a bearing and the epipolar plane of the other, from the mean of both
/// views: like Sampson's distance it is right where one view is nearer than the other.
double SquareError(const Parallax& match, const Eigen::Vector3d& direction) {
  const double along_first = match.first.dot(direction);
  const double along_second = match.second.dot(direction);
  const double volume = match.normal.dot(direction);
  // |t x f|^2 = 1 - (t . f)^2: how far the bearing is from the epipole, where planes have no
  // orientation.
  const double square_sine = 1.0 - 0.5 * (along_first * along_first + along_second * along_second);
  return volume * volume / std::max(square_sine, 1e-12);
}

/// Sum of errors, each at most `square_threshold` (MSAC, Torr and Zisserman 2000). Gives up when
/// above `limit`.
double Cost(const std::vector<Parallax>& matches, const Eigen::Vector3d& direction,
            double square_threshold, double limit) {
  double cost = 0.0;
  for (const Parallax& match : matches) {
    cost += std::min(SquareError(match, direction), square_threshold);
    if (cost >= limit) break;
  }
  return cost;
}

/// Least squares with Geman and McClure's weights: t is where the weighted sum of squares of
/// normal . t is smallest.
Eigen::Vector3d Refine(const std::vector<Parallax>& matches, const Eigen::Vector3d& direction,
                       double square_threshold) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Parallax& match : matches) {
    const double along = match.first.dot(direction);
    const double relative = 1.0 + SquareError(match, direction) / square_threshold;
    const double weight = 1.0 / (relative * relative * std::max(1.0 - along * along, 1e-6));
    sum += weight * match.normal * match.normal.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum);
  return solver.eigenvectors().col(0);
}

/// Samples needed so that one of them holds no outlier with the confidence asked for.
double SamplesNeeded(double inlier_share, double confidence) {
  const double clean = inlier_share * inlier_share;
  if (clean >= 1.0) return 0.0;
  if (clean <= 0.0) return INFINITY;
  return std::log(1.0 - confidence) / std::log1p(-clean);
}

/// Refines as long as that lowers the cost.
void Improve(const std::vector<Parallax>& matches, double square_threshold, int refinements,
             Eigen::Vector3d* direction, double* cost) {
  for (int i = 0; i < refinements; ++i) {
    const Eigen::Vector3d refined = Refine(matches, *direction, square_threshold);
    const double refined_cost = Cost(matches, refined, square_threshold, *cost);
    if (refined_cost >= *cost) break;
    *direction = refined;
    *cost = refined_cost;
  }
}

Eigen::Vector3d FindDirection(const std::vector<Parallax>& matches,
                              const TranslationSearch& search) {
  const double square_threshold = search.threshold * search.threshold;
  Random random(0x7265676fULL, "known rotation");
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  double best_cost = INFINITY;
  double needed = search.max_iterations;
  for (int iteration = 0; iteration < needed; ++iteration) {
    const size_t one = random.Next() % matches.size();
    const size_t other = random.Next() % matches.size();
    Eigen::Vector3d direction = matches[one].normal.cross(matches[other].normal);
    const double length = direction.norm();
    if (!(length > 1e-12)) continue;  // also where both are the same
    direction /= length;
    double cost = Cost(matches, direction, square_threshold, best_cost);
    if (cost >= best_cost) continue;
    // Two noisy bearings make a rough direction; what the refined one gathers decides how long to
    // go on.
    Improve(matches, square_threshold, kRefinements, &direction, &cost);
    best = direction;
    best_cost = cost;
    const auto inliers = std::count_if(matches.begin(), matches.end(), [&](const Parallax& match) {
      return SquareError(match, direction) <= square_threshold;
    });
    const double share = static_cast<double>(inliers) / static_cast<double>(matches.size());
    needed = std::clamp<double>(SamplesNeeded(share, search.confidence), kMinIterations,
                                std::max(kMinIterations, search.max_iterations));
  }
  Improve(matches, square_threshold, kFinalRefinements, &best, &best_cost);
  return best;
}

/// 1 where both cameras see the point before them, -1 where behind, 0 where they differ.
int DepthSign(const Parallax& match, const Eigen::Vector3d& direction) {
  // From d2 second = d1 first + t: d2 normal = first x t and d1 normal = second x t.
  const bool first = match.second.cross(direction).dot(match.normal) > 0.0;
  const bool second = match.first.cross(direction).dot(match.normal) > 0.0;
  return first == second ? (first ? 1 : -1) : 0;
}

/// Whether depths have the signs they seem to have: not where there is little parallax, nor where
/// noise may put the bearing beyond the epipole.
bool HasClearDepths(const Parallax& match, const Eigen::Vector3d& direction,
                    double square_threshold) {
  const double along_first = match.first.dot(direction);
  const double along_second = match.second.dot(direction);
  const double square_sine = 1.0 - std::max(along_first * along_first, along_second * along_second);
  return match.normal.squaredNorm() > 4.0 * square_threshold &&
         square_sine > 4.0 * square_threshold;
}

}  // namespace

Eigen::Vector3d FindTranslation(const RotatedBearings& bearings, const TranslationSearch& search) {
  std::vector<Parallax> matches;
  for (size_t i = 0; i < bearings.first.size(); ++i) {
    const Parallax match = MakeParallax(bearings, i);
    if (!IsWithout(match, search.threshold)) matches.push_back(match);
  }
  return matches.size() < 2 ? Eigen::Vector3d::UnitZ() : FindDirection(matches, search);
}

std::vector<uint8_t> AgreeWithTranslation(const RotatedBearings& bearings,
                                          const Eigen::Vector3d& direction, double threshold) {
  const double square_threshold = threshold * threshold;
  std::vector<uint8_t> agree(bearings.first.size(), 0);
  std::vector<size_t> clear;
  std::vector<int> signs;
  int balance = 0;  // says whether t or -t is meant
  for (size_t i = 0; i < agree.size(); ++i) {
    const Parallax match = MakeParallax(bearings, i);
    if (IsWithout(match, threshold)) {
      agree[i] = 1;
    } else if (SquareError(match, direction) <= square_threshold) {
      agree[i] = 1;
      if (!HasClearDepths(match, direction, square_threshold)) continue;
      clear.push_back(i);
      signs.push_back(DepthSign(match, direction));
      balance += signs.back();
    }
  }
  for (size_t i = 0; i < clear.size(); ++i) {
    if (signs[i] != (balance < 0 ? -1 : 1)) agree[clear[i]] = 0;
  }
  return agree;
}

}  // namespace regolith
