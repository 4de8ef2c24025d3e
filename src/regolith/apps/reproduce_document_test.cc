// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/reproduce_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regolith/core/error.h"

namespace regolith {
namespace {

using ::testing::HasSubstr;

ReproducePlan Plan() {
  ReproduceArguments arguments;
  arguments.seeds = 3;
  arguments.methods = {"lego_loam", "lvi_sam", "paper"};
  return MakePlan(arguments);
}

/// Three seeds on the Moon: LeGO-LOAM at 3, 1, 2 m; LVI-SAM fails once; the paper's method always.
std::vector<SceneResults> Results(const ReproducePlan& plan) {
  std::vector<SceneResults> results;
  for (int i = 0; i < 3; ++i) {
    SceneResults result{plan.scenes[0], plan.seeds[static_cast<size_t>(i)], {}, {}};
    TrackCell lego;
    lego.ape_rmse = i == 0 ? 3.0 : static_cast<double>(i);
    lego.ape_mean = 0.8;
    lego.length = 10.0;
    lego.coverage = 1.0;
    lego.joules = 50.0;
    TrackCell lvi_sam;
    lvi_sam.ape_rmse = 0.5;
    lvi_sam.ape_mean = 0.4;
    if (i == 1) lvi_sam.failure = "ended by a signal";
    TrackCell paper;
    paper.failure = "pipeline x does not exist yet";
    result.tracks = {lego, lvi_sam, paper};
    result.matches.resize(plan.matches.size());
    MatchCell match;
    match.found = 10 * (i + 1);
    match.known = 10;
    match.correct = 9;
    match.same_sun = i != 2;
    match.seconds = 0.5;
    result.matches[0] = {match};
    match.failure = "no package";
    result.matches[1] = {match};
    results.push_back(result);
  }
  return results;
}

std::string TextOf(const DocumentTable& table, size_t row, size_t column) {
  return table.rows.at(row).at(column).text;
}

TEST(ReproduceDocument, ErrorsAreMediansWithTheirSpread) {
  const ReproducePlan plan = Plan();
  const DocumentTable table = ErrorTable(plan, Results(plan), plan.scenes[0]);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(TextOf(table, 0, 1), "18.892");
  EXPECT_EQ(TextOf(table, 0, 3), "2.000 (1.000–3.000)");
  EXPECT_EQ(TextOf(table, 0, 7), "3 of 3");
  EXPECT_FALSE(table.rows[0][3].is_best);
  EXPECT_EQ(TextOf(table, 1, 3), "0.500 (0.500–0.500)");
  EXPECT_EQ(TextOf(table, 1, 7), "2 of 3");
  EXPECT_TRUE(table.rows[1][3].is_best);
  EXPECT_EQ(TextOf(table, 2, 1), "3.164");
  EXPECT_THAT(table.rows[2].back().text, HasSubstr("failed: pipeline x does not exist yet"));
  EXPECT_TRUE(table.rows[2].back().is_failed);
  for (const auto& row : ErrorTable(plan, {}, plan.scenes[1]).rows) {
    EXPECT_EQ(row.back().text, "not made yet");
  }
}

TEST(ReproduceDocument, MatchesAreCountedApartByTheSun) {
  const ReproducePlan plan = Plan();
  const DocumentTable same = MatchTable(plan, Results(plan), plan.scenes[0], true);
  EXPECT_THAT(same.caption, HasSubstr("2 image pairs"));
  EXPECT_EQ(TextOf(same, 0, 4), "15");
  EXPECT_EQ(TextOf(same, 0, 6), "90.0 %");
  EXPECT_EQ(same.rows[1].back().text, "failed: no package");
  EXPECT_EQ(TextOf(MatchTable(plan, Results(plan), plan.scenes[0], false), 0, 4), "30");
  EXPECT_TRUE(MatchTable(plan, Results(plan), plan.scenes[1], true).rows.empty());
}

TEST(ReproduceDocument, CostsGainAndFailuresAreListed) {
  const ReproducePlan plan = Plan();
  std::vector<SceneResults> results = Results(plan);
  EXPECT_EQ(TextOf(CostTable(plan, results, plan.scenes[0]), 0, 4), "5 (5–5)");
  EXPECT_EQ(TextOf(GainTable(plan, results), 0, 3), "–");
  for (SceneResults& result : results) {
    result.tracks[2].failure.clear();
    result.tracks[2].ape_mean = 0.3;
  }
  EXPECT_EQ(TextOf(GainTable(plan, results), 0, 3), "0.100");
  EXPECT_EQ(TextOf(GainTable(plan, results), 0, 4), "25");
  EXPECT_EQ(FailureTable(plan, results).rows.size(), 1U + 3U);
  EXPECT_THAT(CellsCsv(plan, results), HasSubstr("lunar_short,2,lvi_sam,,,,,,,,,,,,,\"ended"));
}

TEST(ReproduceDocument, ThePapersFiguresStandBesideItsExperimentsOnly) {
  ReproduceArguments arguments;
  arguments.scenarios = {"flat"};
  const ReproducePlan plan = MakePlan(arguments);
  for (const auto& row : ErrorTable(plan, {}, plan.scenes[0]).rows) EXPECT_EQ(row[1].text, "–");
}

TEST(ReproducePlan, RefusesWhatItDoesNotKnow) {
  ReproduceArguments arguments;
  arguments.scale = "huge";
  EXPECT_THROW(MakePlan(arguments), InputError);
  arguments.scale = "full";
  EXPECT_EQ(MakePlan(arguments).seeds.size(), 3U);
  EXPECT_EQ(MakePlan(arguments).scenes[0].scenario, "lunar");
  arguments.scenarios = {"flat", "mars"};
  EXPECT_EQ(MakePlan(arguments).scenes[0].name, "flat");
  EXPECT_EQ(MakePlan(arguments).scenes[1].name, "Mars");
  arguments.scenarios = {"flat", "venus"};
  EXPECT_THROW(MakePlan(arguments), InputError);
  arguments.scenarios.clear();
  arguments.methods = {"magic"};
  EXPECT_THROW(MakePlan(arguments), InputError);
  arguments.methods.clear();
  arguments.seeds = 0;
  EXPECT_THROW(MakePlan(arguments), InputError);
}

}  // namespace
}  // namespace regolith
