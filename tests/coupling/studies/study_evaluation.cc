// diptych: errors, classes and costs of points with known numbers
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_cost.h"

#include <cmath>

#include <gtest/gtest.h>

#include "coupling/studies/study_evaluation.h"

namespace
{
  using namespace diptych::coupling;

  // One quantity with a limit of 2 %, four samples, one axis of `n` points.
  Study study_of(const int n)
  {
    Study study;
    study.seeds = {1, 2, 3, 4};
    StudyQuantity strength;
    strength.name  = "strength";
    strength.limit = 0.02;
    study.quantities.push_back(strength);
    Family family;
    family.axes.push_back({"step", true, false, {}});
    for (int k = 0; k < n; ++k)
      family.axes.front().points.push_back({std::to_string(k), {}, std::pow(2., k)});
    study.families.push_back(family);
    return study;
  }

  std::vector<ScenePoint> points_on(const int n)
  {
    std::vector<ScenePoint> points(1);
    for (int k = 0; k < n; ++k)
      points.push_back({0, 0, {std::size_t(k)}, {std::to_string(k)}, {}, {}});
    return points;
  }

  // Four samples around 0.4, all changed by the same share.
  std::vector<RunResult> runs(const double share, const double cpu_s = 1)
  {
    std::vector<RunResult> result(4);
    const double           samples[] = {0.38, 0.40, 0.41, 0.43};
    for (int k = 0; k < 4; ++k)
      {
        result[k].is_known = true;
        result[k].values   = {samples[k] * (1 + share)};
        result[k].phases   = {{"discrete", cpu_s, cpu_s, 100}, {"report", 9, 9, 100}};
      }
    return result;
  }

  PointRecord point_of(const std::vector<RunResult> &run)
  {
    return evaluate(study_of(1), points_on(1), {runs(0), run}).points[1];
  }

  TEST(StudyEvaluation, ErrorsArePairedBySample)
  {
    // The samples scatter by 5 %. The change of 1 % is visible because it is the same in each sample.
    const PointRecord point = point_of(runs(0.01));
    EXPECT_NEAR(point.quantities[0].error.value, 0.01, 1e-12);
    EXPECT_NEAR(point.quantities[0].error.low, 0.01, 1e-9);
    EXPECT_EQ(point.quantities[0].pairs, 4);
    EXPECT_EQ(point.kind, PointClass::right);
    EXPECT_TRUE(point.is_certain);
  }

  TEST(StudyEvaluation, ErrorsThatScatterLeaveADoubt)
  {
    std::vector<RunResult> scattered = runs(0.01);
    scattered[0].values[0] *= 1.05, scattered[1].values[0] *= 0.95;
    const PointRecord point = point_of(scattered);
    EXPECT_EQ(point.quantities[0].verdict, "cannot tell");
    EXPECT_EQ(point.kind, PointClass::right) << "its mean is within the limit";
    EXPECT_FALSE(point.is_certain);
  }

  TEST(StudyEvaluation, SilentErrorsAreDistinguishedFromWarnedOnes)
  {
    EXPECT_EQ(point_of(runs(0.03)).kind, PointClass::silently_wrong);
    std::vector<RunResult> warned = runs(0.03);
    warned[2].warned              = true;
    EXPECT_EQ(point_of(warned).kind, PointClass::wrong_warned);
  }

  TEST(StudyEvaluation, TheWorstRunDecides)
  {
    std::vector<RunResult> struggled = runs(0);
    struggled[1].halved_steps        = 3;
    EXPECT_EQ(point_of(struggled).kind, PointClass::struggled);
    std::vector<RunResult> stopped = runs(0);
    stopped[3].exit_code = 3, stopped[3].values = {NAN}, stopped[3].words = "did not converge";
    EXPECT_EQ(point_of(stopped).kind, PointClass::stopped);
    EXPECT_EQ(point_of(stopped).words, "did not converge");
    std::vector<RunResult> refused = stopped;
    refused[0].exit_code = 2, refused[0].is_refused = true;
    EXPECT_EQ(point_of(refused).kind, PointClass::refused);
    std::vector<RunResult> missing = refused;
    missing[1].is_known            = false;
    EXPECT_EQ(point_of(missing).kind, PointClass::not_run);
  }

  TEST(StudyEvaluation, AValueThatOnlyTheReferenceHasIsBeyondAnyLimit)
  {
    std::vector<RunResult> none = runs(0);
    for (RunResult &run : none)
      run.values = {NAN};
    EXPECT_EQ(point_of(none).kind, PointClass::silently_wrong);
  }

  TEST(StudyEvaluation, WithoutAReferenceValueNothingIsJudged)
  {
    std::vector<RunResult> none = runs(0);
    for (RunResult &run : none)
      run.values = {NAN};
    EXPECT_EQ(evaluate(study_of(1), points_on(1), {none, none}).points[1].kind, PointClass::unjudged);
  }

  TEST(StudyEvaluation, AnUnknownIntervalLeavesADoubtUnlessThereIsOneSample)
  {
    Study      study = study_of(1);
    const auto one   = [](const double share) { return std::vector<RunResult>(1, runs(share).front()); };
    study.seeds      = {1};
    EXPECT_FALSE(evaluate(study, points_on(1), {one(0), one(0.05)}).points[1].is_certain);
    EXPECT_EQ(evaluate(study, points_on(1), {one(0), one(0.05)}).points[1].kind, PointClass::silently_wrong);
    study.seeds.clear();
    EXPECT_TRUE(evaluate(study, points_on(1), {one(0), one(0.05)}).points[1].is_certain);
  }

  TEST(StudyEvaluation, WithoutLimitsNothingIsJudged)
  {
    Study study = study_of(1);
    study.quantities[0].limit.reset();
    const StudyRecord record = evaluate(study, points_on(1), {runs(0), runs(0.5)});
    EXPECT_EQ(record.points[1].kind, PointClass::unjudged);
    EXPECT_NEAR(record.points[1].quantities[0].error.value, 0.5, 1e-12);
  }

  TEST(StudyEvaluation, LinesAreComparedByTheirTurn)
  {
    Study study                      = study_of(1);
    study.quantities[0].is_line      = true;
    study.quantities[0].is_relative  = false;
    study.quantities[0].limit        = 5;
    std::vector<RunResult> reference = runs(0), turned = runs(0);
    for (int k = 0; k < 4; ++k)
      reference[k].values = {89.}, turned[k].values = {-88.};
    EXPECT_NEAR(evaluate(study, points_on(1), {reference, turned}).points[1].quantities[0].error.value, 3, 1e-9);
  }

  TEST(StudyEvaluation, OrdersAreFittedAlongAxesThatConverge)
  {
    const Study       study  = study_of(4); // h = 1, 2, 4, 8
    const StudyRecord record = evaluate(study, points_on(4), {runs(0), runs(0.01), runs(0.02), runs(0.04), runs(0.08)});
    ASSERT_EQ(record.orders.size(), 1u);
    EXPECT_NEAR(record.orders[0].order.value, 1, 0.02);
    EXPECT_NEAR(record.orders[0].limit.value, 0.405, 1e-3) << "the mean over the samples";
    EXPECT_LT(record.orders[0].limit.low, 0.405);
    EXPECT_GT(record.orders[0].limit.high, 0.405);
  }

  TEST(StudyEvaluation, ScatterIsThatOfOneSampleOverTheMean)
  {
    const StudyRecord record = evaluate(study_of(1), points_on(1), {runs(0), runs(0)});
    EXPECT_NEAR(record.points[1].quantities[0].scatter, 0.020817 / 0.405, 1e-5);
  }

  TEST(StudyCost, TheCheapestRightPointIsFoundAndTheReferenceDoesNotCompete)
  {
    const Study        study   = study_of(3);
    const StudyResults results = {runs(0, 0.1), runs(0.005, 8), runs(-0.015, 2), runs(0.04, 1)};
    const StudyCost    cost    = cost_of(study, points_on(3), results, evaluate(study, points_on(3), results));
    ASSERT_EQ(cost.points.size(), 4u);
    EXPECT_DOUBLE_EQ(cost.points[2].cpu_s, 2) << "the report does not count";
    const auto cheapest = [&](const std::string &quantity, const double accuracy) {
      for (const CheapestPoint &one : cost.cheapest)
        if (one.quantity == quantity && one.accuracy == accuracy)
          return one.point;
      return -2;
    };
    EXPECT_EQ(cheapest("strength", 0.05), 3);
    EXPECT_EQ(cheapest("strength", 0.02), 2);
    EXPECT_EQ(cheapest("strength", 0.01), 1);
    EXPECT_EQ(cheapest("", 0.5), 1);
    EXPECT_EQ(cost.points[1].front_of.size(), 1u);
  }

  TEST(StudyCost, WithoutALimitNoPointIsTheCheapestRightOne)
  {
    Study study = study_of(2);
    study.quantities[0].limit.reset();
    const StudyResults results = {runs(0), runs(0.01, 1), runs(0.02, 2)};
    const StudyCost    cost    = cost_of(study, points_on(2), results, evaluate(study, points_on(2), results));
    EXPECT_EQ(cost.points.size(), 3u);
    EXPECT_TRUE(cost.cheapest.empty());
  }

  TEST(StudyCost, APointThatCostsMoreAndIsWorseIsNotOnTheFront)
  {
    const Study        study   = study_of(2);
    const StudyResults results = {runs(0), runs(0.01, 1), runs(0.02, 2)};
    const StudyCost    cost    = cost_of(study, points_on(2), results, evaluate(study, points_on(2), results));
    EXPECT_EQ(cost.points[1].front_of, std::vector<std::string>{"strength"});
    EXPECT_TRUE(cost.points[2].front_of.empty());
  }

  TEST(StudyCost, PointsCompeteOnlyWithThoseOfTheSameReference)
  {
    const Study             study  = study_of(2);
    std::vector<ScenePoint> points = points_on(2);
    points.insert(points.begin(), ScenePoint());
    points[1].reference = points[3].reference = 1;
    const StudyResults results                = {runs(0), runs(1), runs(0.01, 1), runs(1.01, 2)};
    const StudyRecord  record                 = evaluate(study, points, results);
    EXPECT_NEAR(record.points[3].quantities[0].error.value, 0.005, 1e-9) << "twice the samples, plus 0.5 %";
    const StudyCost cost = cost_of(study, points, results, record);
    EXPECT_EQ(cost.points[2].front_of.size(), 1u);
    EXPECT_EQ(cost.points[3].front_of.size(), 1u) << "it costs more, but no cheaper point shares its reference";
    EXPECT_EQ(cost.cheapest.size(), 12u);
    EXPECT_EQ(cost.cheapest.back().point, 3);
  }

  TEST(StudyCost, OtherWorkOnTheMachineIsNoticed)
  {
    RunResult run;
    run.at_once = 2, run.load = 2.3;
    EXPECT_FALSE(is_disturbed(run));
    run.load = 3.1;
    EXPECT_TRUE(is_disturbed(run));
  }
} // namespace
