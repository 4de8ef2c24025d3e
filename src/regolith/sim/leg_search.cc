// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/sim/leg_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include <Eigen/Geometry>

#include "regolith/core/check.h"
#include "regolith/sim/uniform_spline.h"

namespace regolith {
namespace {

constexpr double kCell = 0.25;          // m
constexpr int kCurvatures = 5;          // from the sharpest to the left to that to the right
constexpr double kHitCost = 8.0;        // m of way worth a rock under a wheel
constexpr double kAwayCost = 0.05;      // share of the way, a squared metre away from the nominal
constexpr double kSlopeCost = 1.0;      // share of the way, on the steepest ground
constexpr double kBendCost = 0.15;      // share of the way, in the sharpest curve
constexpr double kTurnCost = 3.5;       // m, a radian between the wanted and the real point turn
constexpr double kWidestStart = 0.9;    // rad, either side of the nominal heading
constexpr double kGreed = 1.3;          // weight of the distance left (weighted A*)
constexpr double kAxleReach = 0.6;      // m, of the wheels' front and back from the base
constexpr int kParametersPerStep = 10;  // of the table of arc lengths

double Heading(const Eigen::Vector2d& vector) { return std::atan2(vector.y(), vector.x()); }

class Search {
 public:
  Search(const LegRequest& request, DriveMap* map) : request_(request), map_(*map) {
    Eigen::AlignedBox2d box(request.start);
    for (const Eigen::Vector2d& point : request.nominal) box.extend(point);
    corner_ = box.min() - Eigen::Vector2d::Constant(request.corridor + kCell);
    const Eigen::Vector2d size =
        (box.max() - corner_) + Eigen::Vector2d::Constant(request.corridor + kCell);
    columns_ = static_cast<int>(size.x() / kCell) + 1;
    rows_ = static_cast<int>(size.y() / kCell) + 1;
    headings_ = static_cast<int>(std::ceil(2.0 * M_PI / (request.curvature * kLegStep)));
    const auto cells = static_cast<size_t>(columns_) * static_cast<size_t>(rows_);
    place_cost_.assign(cells, -1.0F);
    closed_.assign(cells * static_cast<size_t>(headings_), false);
  }

  std::optional<std::vector<Eigen::Vector2d>> Run() {
    AddStarts();
    while (!queue_.empty()) {
      const Open open = queue_.top();
      queue_.pop();
      const Node node = nodes_[open.node];
      if (node.is_end) return Trace(open.node);
      const size_t state = State(node);
      if (closed_[state]) continue;
      closed_[state] = true;
      if ((node.position - request_.nominal.back()).norm() < kGoalRadius) End(open.node, node);
      Expand(open.node, node);
    }
    return std::nullopt;
  }

 private:
  struct Node {
    Eigen::Vector2d position;
    double yaw;
    double cost;
    int parent;
    int curvature;        // index, -1 at the start
    bool is_end = false;  // a copy of its parent: the leg may end here
  };
  struct Open {
    double total;
    size_t node;
    // The cheapest first; of equals, the older.
    bool operator<(const Open& other) const {
      return total != other.total ? total > other.total : node > other.node;
    }
  };

  size_t Cell(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d inside = (place - corner_) / kCell;
    return static_cast<size_t>(inside.y()) * static_cast<size_t>(columns_) +
           static_cast<size_t>(inside.x());
  }

  size_t State(const Node& node) const {
    const double turns = node.yaw / (2.0 * M_PI);
    const int heading = static_cast<int>((turns - std::floor(turns)) * headings_) % headings_;
    return Cell(node.position) * static_cast<size_t>(headings_) + static_cast<size_t>(heading);
  }

  // Cost of a metre there by slope and by distance from the nominal leg; infinite where closed.
  double PlaceCost(const Eigen::Vector2d& place) {
    const Eigen::Vector2d inside = place - corner_;
    if (inside.minCoeff() < 0.0 || inside.x() >= columns_ * kCell || inside.y() >= rows_ * kCell) {
      return std::numeric_limits<double>::infinity();
    }
    float& cost = place_cost_[Cell(place)];
    if (cost >= 0.0F) return static_cast<double>(cost);
    double away = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& point : request_.nominal) {
      away = std::min(away, (point - place).squaredNorm());
    }
    const double steepness = map_.Steepness(place);
    const bool open = steepness < 1.0 && away < request_.corridor * request_.corridor;
    cost = open ? static_cast<float>(1.0 + kAwayCost * away + kSlopeCost * std::pow(steepness, 4.0))
                : std::numeric_limits<float>::infinity();
    return static_cast<double>(cost);
  }

  void Push(const Node& node) {
    nodes_.push_back(node);
    const double left = (node.position - request_.nominal.back()).norm();
    queue_.push({node.cost + kGreed * left, nodes_.size() - 1});
  }

  void AddStarts() {
    const std::vector<Eigen::Vector2d>& nominal = request_.nominal;
    const double ahead = Heading(nominal[std::min<size_t>(6, nominal.size() - 1)] - request_.start);
    const double step = request_.curvature * kLegStep;
    const int reach = static_cast<int>(kWidestStart / step);
    for (int i = -reach; i <= reach; ++i) {
      const double yaw = ahead + i * step;
      const double turn = std::remainder(yaw - request_.arrival_yaw, 2.0 * M_PI);
      const int hits = AxleHits(request_.start, yaw, -1.0);
      Push({request_.start, yaw, kTurnCost * std::abs(turn - request_.turn) + kHitCost * hits, -1,
            -1});
    }
  }

  // Rocks under the wheels behind (side -1) a first or before (side 1) a last place.
  int AxleHits(const Eigen::Vector2d& place, double yaw, double side) {
    const Eigen::Vector2d middle =
        place + side * 0.5 * kAxleReach * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    return std::max(0, map_.TrackHits(middle, yaw, kAxleReach));
  }

  // The rover may stop at the node and turn there.
  void End(size_t index, const Node& node) {
    const int turn_hits = map_.TurnHits(node.position);
    if (turn_hits < 0) return;
    Node end = node;
    end.cost += kHitCost * (turn_hits + AxleHits(node.position, node.yaw, 1.0));
    end.parent = static_cast<int>(index);
    end.is_end = true;
    Push(end);
  }

  void Expand(size_t index, const Node& node) {
    for (int i = 0; i < kCurvatures; ++i) {
      const double share = 1.0 - 2.0 * i / (kCurvatures - 1);
      const double turn = share * request_.curvature * kLegStep;
      Node next = node;
      next.yaw = node.yaw + turn;
      const double middle = node.yaw + 0.5 * turn;
      const Eigen::Vector2d step = kLegStep * Eigen::Vector2d(std::cos(middle), std::sin(middle));
      next.position = node.position + step;
      const double place = PlaceCost(next.position);
      if (!std::isfinite(place) || closed_[State(next)]) continue;
      const int hits = map_.TrackHits(node.position + 0.5 * step, middle, kLegStep);
      if (hits < 0) continue;
      const double change = node.curvature < 0 ? 0.0 : std::abs(node.curvature - i);
      next.cost +=
          kLegStep * (place + kBendCost * (std::abs(share) + 0.5 * change)) + kHitCost * hits;
      next.parent = static_cast<int>(index);
      next.curvature = i;
      Push(next);
    }
  }

  std::vector<Eigen::Vector2d> Trace(size_t last) const {
    std::vector<Eigen::Vector2d> points;
    for (int i = nodes_[last].parent; i >= 0; i = nodes_[static_cast<size_t>(i)].parent) {
      points.push_back(nodes_[static_cast<size_t>(i)].position);
    }
    std::reverse(points.begin(), points.end());
    return points;
  }

  const LegRequest& request_;
  DriveMap& map_;
  Eigen::Vector2d corner_;
  int columns_ = 0;
  int rows_ = 0;
  int headings_ = 0;
  std::vector<float> place_cost_;  // negative: not known yet
  std::vector<bool> closed_;
  std::vector<Node> nodes_;
  std::priority_queue<Open> queue_;
};

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> FindLeg(const LegRequest& request, DriveMap* map) {
  REGOLITH_CHECK(request.nominal.size() > 1, "a leg has two ends");
  auto points = Search(request, map).Run();
  if (points && points->size() < 4) return std::nullopt;
  return points;
}

LegCurve::LegCurve(std::vector<Eigen::Vector2d> points) {
  REGOLITH_CHECK(points.size() >= 2, points.size());
  // Points beyond both ends that make the curve start and end in them, without curvature there.
  controls_.push_back(2.0 * points[0] - points[1]);
  controls_.insert(controls_.end(), points.begin(), points.end());
  controls_.push_back(2.0 * points.back() - points[points.size() - 2]);
  const size_t steps = (points.size() - 1) * kParametersPerStep;
  lengths_.push_back(0.0);
  Eigen::Vector2d last = points[0];
  for (size_t i = 1; i <= steps; ++i) {
    const Eigen::Vector2d next = AtParameter(static_cast<double>(i) / kParametersPerStep).position;
    lengths_.push_back(lengths_.back() + (next - last).norm());
    last = next;
  }
}

LegCurve::Sample LegCurve::AtParameter(double parameter) const {
  const size_t last_piece = controls_.size() - 4;
  const size_t piece = std::min(static_cast<size_t>(std::max(parameter, 0.0)), last_piece);
  const double u = parameter - static_cast<double>(piece);
  const auto values = UniformBasis<3>(u);
  const auto firsts = UniformBasis<2>(u);
  const auto seconds = UniformBasis<1>(u);
  const Eigen::Vector2d* c = &controls_[piece];
  Sample sample;
  sample.position.setZero();
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d second = Eigen::Vector2d::Zero();
  for (size_t j = 0; j < 4; ++j) sample.position += values[j] * c[j];
  for (size_t j = 0; j < 3; ++j) first += firsts[j] * (c[j + 1] - c[j]);
  for (size_t j = 0; j < 2; ++j) second += seconds[j] * (c[j + 2] - 2.0 * c[j + 1] + c[j]);
  sample.yaw = Heading(first);
  sample.curvature =
      (first.x() * second.y() - first.y() * second.x()) / std::pow(first.norm(), 3.0);
  return sample;
}

LegCurve::Sample LegCurve::At(double distance) const {
  const double wanted = std::clamp(distance, 0.0, length());
  const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, wanted);
  const double low = *(above - 1);
  const double fraction = *above > low ? (wanted - low) / (*above - low) : 0.0;
  const double index = static_cast<double>(above - lengths_.begin() - 1);
  return AtParameter((index + fraction) / kParametersPerStep);
}

}  // namespace regolith
