// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

namespace regolith {

/// A frontend that can be asked for, and the network (models/MODEL.yaml) that it runs.
struct FrontendName {
  const char* name;
  const char* model;  ///< empty: none
};

inline constexpr std::array<FrontendName, 6> kFrontends = {{{"ghost", "ghost"},
                                                            {"ghost_paper", "ghost_paper"},
                                                            {"ghost_lk", "ghost"},
                                                            {"superpoint", "superpoint"},
                                                            {"orb", ""},
                                                            {"st_lk", ""}}};

/// How detection thresholds adapt. The image is cut into cells of about `cell_size`; each has a
/// threshold of its own that moves from frame to frame towards the score which would give the cell
/// its even share of keypoints, and all of them move together within a frame until the number asked
/// for is met.
struct AdaptiveThresholdOptions {
  bool enabled = true;    ///< false: one fixed threshold, `initial`
  int cell_size = 80;     ///< pixels
  double initial = 0.02;  ///< score, where the thresholds do not adapt
  double floor = 0.01;    ///< lowest score of a keypoint
  /// Grey levels, standard deviation of the 7 × 7 pixels around a keypoint of a network, at least:
  /// what is less is the sensor's noise in flat shadow and black sky. 0: no such test.
  double min_contrast = 2.0;
  double evenness = 0.3;  ///< 0: one threshold for all cells; 1: as many keypoints in each
  double memory = 0.5;    ///< weight of the last frame's threshold (of its logarithm)

  void Check() const;
};

struct NetworkOptions {
  std::string model;               ///< name or manifest; empty: the one that the frontend is for
  std::string precision = "auto";  ///< f32, bf16, or auto: bf16 where the processor has it
  int threads = 2;                 ///< of inference
  std::string cache;               ///< folder of compiled models; empty: none
  bool normalise_contrast =
      false;  ///< stretch dark and flat images before inference; no gain was measured

  void Check() const;
};

struct OpticalFlowOptions {
  int window = 21;                ///< pixels, side of the patch
  int pyramid_levels = 3;         ///< beside the image itself
  int max_iterations = 30;        ///< a level
  double forward_backward = 0.5;  ///< pixels; the way back must end this near the start
  double min_eigenvalue = 1e-4;   ///< of the patch's normalised gradient matrix

  void Check() const;
};

struct OrbOptions {
  int levels = 8;
  double scale_factor = 1.2;
  int fast_threshold = 20;  ///< grey levels
  int fast_floor = 5;       ///< grey levels, where a cell has none

  void Check() const;
};

struct ShiTomasiOptions {
  double quality = 0.01;  ///< share of the strongest corner's eigenvalue
  int block = 3;          ///< pixels

  void Check() const;
};

struct DescriptorMatcherOptions {
  double ratio = 0.95;          ///< distance to the nearest over distance to the second
  double min_similarity = 0.6;  ///< inner product, float descriptors
  int max_hamming = 64;         ///< bits, binary descriptors
  bool mutual = true;
  /// A pair of images is matched a second time, near where the first time's inliers lead: there
  /// a match may be less sure.
  bool guided = true;
  double guided_ratio = 0.95;
  double guided_similarity = 0.5;
  /// The farther image of a pair is looked at a second time as from where the other was taken, by
  /// the homography of the first time's inliers.
  bool second_look = true;

  void Check() const;
};

struct OutlierRejectionOptions {
  double epipolar_sigma =
      1.0;  ///< pixels; a match further from its epipolar line than twice this is an outlier
  double confidence = 0.999;
  int max_iterations = 1000;
  int min_matches = 12;           ///< with fewer, epipolar geometry is not estimated
  int neighbours = 8;             ///< of the test against the motion of neighbours; 0: no such test
  double neighbour_spread = 3.0;  ///< of how far neighbours differ, that a match may differ by ...
  double neighbour_pixels = 4.0;  ///< ... beyond these pixels

  void Check() const;
};

struct TrackMemoryOptions {
  int frames = 10;              ///< that a lost track is remembered by its descriptor
  double search_radius = 60.0;  ///< pixels around the predicted place; grows with the time lost

  void Check() const;
};

inline constexpr int kMaxKeypoints = 20000;

struct FeatureOptions {
  std::string frontend = "ghost";  ///< one of kFrontends
  int max_keypoints = 500;         ///< 1 to kMaxKeypoints
  int min_distance = 8;            ///< pixels between keypoints of st_lk and of tracked points
  int nms_radius = 4;              ///< pixels; no two keypoints of a network are nearer
  int border = 4;                  ///< pixels without keypoints along the image's edge
  double redetect_share =
      0.9;  ///< LK frontends: of max_keypoints tracked, below which new points are looked for
  AdaptiveThresholdOptions adaptive;
  NetworkOptions network;
  OpticalFlowOptions optical_flow;
  OrbOptions orb;
  ShiTomasiOptions shi_tomasi;
  DescriptorMatcherOptions matcher;
  OutlierRejectionOptions rejection;
  TrackMemoryOptions memory;

  /// Throws CheckError on values that make no frontend.
  void Check() const;
};

}  // namespace regolith
