// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/terrain/dem_relief.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "regolith/core/random.h"

namespace regolith {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kLowestHurst = 0.3;
constexpr double kHighestHurst = 0.98;
constexpr int kProfiles = 6000;
constexpr int kTries = 60000;
constexpr size_t kFewestProfiles = 200;
constexpr double kWideBox = 10.0;  // effective resolutions, half of its side
// A model that ends so near 1 m leaves no span over which an exponent could be found.
constexpr double kShortestSpan = 2.0;  // m
// The baseline of a slope sees waves of twice its length best.
constexpr double kKnee = 2.0;  // m, wavelength at which the exponent changes
// Second differences a quarter of the effective resolution apart see what is added, hardly the
// model.
constexpr double kJoin = 0.25;
constexpr double kHiddenStep = 1.5;  // of the amplitude

struct Profile {
  Eigen::Vector2d middle;
  Eigen::Vector2d way;  // of unit length
};

// Profiles at seeded places of the box, those whose ends are known to the model; where these are
// too few, any.
std::vector<Profile> DrawProfiles(const Dem& dem, const Eigen::AlignedBox2d& box, double reach) {
  Random random(1, "elevation model statistics");
  std::vector<Profile> known;
  std::vector<Profile> any;
  for (int i = 0; i < kTries && known.size() < kProfiles; ++i) {
    const Eigen::Vector2d middle(random.Uniform(box.min().x(), box.max().x()),
                                 random.Uniform(box.min().y(), box.max().y()));
    const double angle = random.Uniform(0.0, 2.0 * M_PI);
    const Profile profile{middle, {std::cos(angle), std::sin(angle)}};
    if (any.size() < kProfiles) any.push_back(profile);
    if (dem.HasData(middle.x(), middle.y(), reach)) known.push_back(profile);
  }
  return known.size() < kFewestProfiles ? any : known;
}

// Moves profiles onto posts and along their lines: between posts the model is smoother than it is.
void SnapToPosts(const Dem& dem, std::vector<Profile>* profiles) {
  for (Profile& profile : *profiles) {
    const Eigen::Vector2d post = (profile.middle + dem.half_size()) / dem.spacing();
    profile.middle = dem.spacing() * post.array().round().matrix() - dem.half_size();
    const bool east = std::abs(profile.way.x()) > std::abs(profile.way.y());
    profile.way = east ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
  }
}

// Ground enough to see waves of the effective resolution many times.
Eigen::AlignedBox2d WideBox(const Dem& dem, const Eigen::AlignedBox2d& box, double resolution) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(kWideBox * resolution);
  const Eigen::AlignedBox2d wide(box.center() - half, box.center() + half);
  return box.merged(wide).intersection({-dem.half_size(), dem.half_size()});
}

std::vector<double> FirstDifferences(const std::vector<Profile>& profiles,
                                     const HeightFunction& height, double lag) {
  std::vector<double> differences;
  for (const Profile& profile : profiles) {
    const Eigen::Vector2d end = profile.middle + lag * profile.way;
    differences.push_back(height(end.x(), end.y()) -
                          height(profile.middle.x(), profile.middle.y()));
  }
  return differences;
}

// They see waves about two lags long, and no slope: what is continuous in them is continuous in the
// spectrum.
std::vector<double> SecondDifferences(const std::vector<Profile>& profiles,
                                      const HeightFunction& height, double lag) {
  std::vector<double> differences;
  for (const Profile& profile : profiles) {
    const Eigen::Vector2d end = profile.middle + lag * profile.way;
    const Eigen::Vector2d other = profile.middle - lag * profile.way;
    differences.push_back(height(end.x(), end.y()) + height(other.x(), other.y()) -
                          2.0 * height(profile.middle.x(), profile.middle.y()));
  }
  return differences;
}

// Takes the slope of the plane that fits best out of first differences.
void Level(const std::vector<Profile>& profiles, std::vector<double>* differences, double lag) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < profiles.size(); ++i) {
    const Eigen::Vector2d way = lag * profiles[i].way;
    normal += way * way.transpose();
    right += (*differences)[i] * way;
  }
  const Eigen::Vector2d slope = normal.inverse() * right;
  for (size_t i = 0; i < profiles.size(); ++i) {
    (*differences)[i] -= lag * slope.dot(profiles[i].way);
  }
}

double Figure(SlopeStatistic statistic, std::vector<double> values) {
  return statistic == SlopeStatistic::kRms ? RootMeanSquare(values)
                                           : MedianMagnitude(std::move(values));
}

// The sum of what is given and of noise at a scale.
double FigureOfSum(SlopeStatistic statistic, const std::vector<double>& given,
                   const std::vector<double>& noise, double scale) {
  std::vector<double> sum = given;
  for (size_t i = 0; i < sum.size(); ++i) sum[i] += scale * noise[i];
  return Figure(statistic, std::move(sum));
}

// The scale at which the sum has the figure; 0 where what is given has more already.
double ScaleFor(SlopeStatistic statistic, const std::vector<double>& given,
                const std::vector<double>& noise, double figure) {
  double high = figure / std::max(Figure(statistic, noise), 1e-12);
  while (FigureOfSum(statistic, given, noise, high) < figure) high *= 2.0;
  double low = 0.0;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (FigureOfSum(statistic, given, noise, middle) > figure ? high : low) = middle;
  }
  return low;
}

// Amplitude over the wavelength (m), 1 at the knee.
double Trend(double wavelength, double hurst, double fine_hurst) {
  return std::pow(wavelength / kKnee, wavelength < kKnee ? fine_hurst : hurst);
}

class Continuation {
 public:
  Continuation(const Dem& dem, double resolution, const HeightFunction& features,
               const ReliefOptions& options, const Eigen::AlignedBox2d& box, uint64_t seed)
      : options_(options),
        resolution_(resolution),
        model_lag_(dem.spacing() * std::round(resolution / dem.spacing())),
        seed_(seed),
        profiles_(DrawProfiles(dem, box, 1.0)) {
    const HeightFunction model = [&dem](double x, double y) { return dem.Height(x, y); };
    const HeightFunction shaped = [&](double x, double y) {
      return dem.Height(x, y) + features(x, y);
    };
    std::vector<Profile> wide =
        DrawProfiles(dem, WideBox(dem, box, resolution), model_lag_ + dem.spacing());
    SnapToPosts(dem, &wide);
    roughness_ = Figure(options.statistic, SecondDifferences(wide, model, model_lag_));
    joined_ = SecondDifferences(profiles_, shaped, kJoin * resolution);
    sloped_ = FirstDifferences(profiles_, shaped, 1.0);
    Level(profiles_, &sloped_, 1.0);
  }

  DemRelief Continue() const {
    if (resolution_ < kShortestSpan) return Joined(options_.hurst, false);
    DemRelief relief = Joined(kHighestHurst, true);
    if (relief.report.slope_at_1m_deg >= options_.slope_deg) return Softened();
    relief = Joined(kLowestHurst, true);
    if (relief.report.slope_at_1m_deg <= options_.slope_deg) return Kept(kLowestHurst, true);
    double low = kLowestHurst;
    double high = kHighestHurst;
    for (int i = 0; i < 10; ++i) {
      const double middle = 0.5 * (low + high);
      relief = Joined(middle, false);
      (relief.report.slope_at_1m_deg > options_.slope_deg ? low : high) = middle;
    }
    return relief;
  }

 private:
  FractalNoise Noise(double hurst) const {
    return {seed_, std::max(M_SQRT1_2 * resolution_, options_.shortest_wavelength),
            options_.shortest_wavelength,
            [&](double wavelength) { return Trend(wavelength, hurst, options_.hurst); }};
  }

  // Relief that goes on where the model ends.
  DemRelief Joined(double hurst, bool clamped) const {
    const FractalNoise noise = Noise(hurst);
    return Scaled(noise, JoiningScale(noise, hurst), hurst, clamped);
  }

  // Relief that keeps the slopes over 1 m, wherever the model lies.
  DemRelief Kept(double hurst, bool clamped) const {
    const FractalNoise noise = Noise(hurst);
    return Scaled(noise, KeepingScale(noise), hurst, clamped);
  }

  // The model is rougher than the statistics: relief that keeps the slopes over 1 m as far as a
  // step in the spectrum that does not show allows.
  DemRelief Softened() const {
    const FractalNoise noise = Noise(kHighestHurst);
    const double scale =
        std::max(KeepingScale(noise), JoiningScale(noise, kHighestHurst) / kHiddenStep);
    return Scaled(noise, scale, kHighestHurst, true);
  }

  double JoiningScale(const FractalNoise& noise, double hurst) const {
    const double lag = kJoin * resolution_;
    const double share =
        Trend(2.0 * lag, hurst, options_.hurst) / Trend(2.0 * model_lag_, hurst, options_.hurst);
    const std::vector<double> rough = SecondDifferences(profiles_, Of(noise), lag);
    return ScaleFor(options_.statistic, joined_, rough, share * roughness_);
  }

  double KeepingScale(const FractalNoise& noise) const {
    const std::vector<double> rough = FirstDifferences(profiles_, Of(noise), 1.0);
    return ScaleFor(options_.statistic, sloped_, rough, std::tan(options_.slope_deg * kDegree));
  }

  DemRelief Scaled(FractalNoise noise, double scale, double hurst, bool clamped) const {
    const std::vector<double> rough = FirstDifferences(profiles_, Of(noise), 1.0);
    const double slope = FigureOfSum(options_.statistic, sloped_, rough, scale);
    noise.Scale(scale);
    return {std::move(noise), {hurst, std::atan(slope) / kDegree, 0.0, resolution_, clamped}};
  }

  static HeightFunction Of(const FractalNoise& noise) {
    return [&noise](double x, double y) { return noise.At(x, y, 0.0); };
  }

  ReliefOptions options_;
  double resolution_;
  double model_lag_;  // m, about the effective resolution
  uint64_t seed_;
  std::vector<Profile> profiles_;
  double roughness_ = 0.0;      // m, of the model over model_lag_
  std::vector<double> joined_;  // m, of model and features, just below
  std::vector<double> sloped_;  // m, over 1 m
};

}  // namespace

DemRelief ContinueRelief(const Dem& dem, double effective_resolution,
                         const HeightFunction& features, const ReliefOptions& options,
                         const Eigen::AlignedBox2d& box, uint64_t seed) {
  DemRelief relief =
      Continuation(dem, effective_resolution, features, options, box, seed).Continue();
  relief.report.pixel = dem.spacing();
  return relief;
}

}  // namespace regolith
