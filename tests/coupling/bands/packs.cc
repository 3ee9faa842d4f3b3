// diptych: tests of the conditions for two packs, and of remainders of a smooth field that a tanh fits
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"
#include "coupling/bands/packs.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling::synthetic;
  using diptych::tests::expect_words;

  Band band_at(const double angle_deg, const double offset, const double jump)
  {
    Band band;
    band.angle_deg = angle_deg;
    band.offset    = offset;
    band.jump      = jump;
    return band;
  }

  // 52 x 75, a line at 45 degrees through the middle. It meets the sides 26 below and above the centre; the platens are 37.5
  // away.
  TEST(Packs, LineThroughBothSidesDividesTheSampleIntoTwo)
  {
    EXPECT_EQ(objection_to_packs(band_at(-45, 0, 1), frame_52_75(), true), "");
    // 8.1 along the normal is 11.5 along the side, so the line ends exactly at the corner.
    EXPECT_EQ(objection_to_packs(band_at(-45, 8.1, 1), frame_52_75(), true), "");
    EXPECT_EQ(objection_to_packs(band_at(0, 3, 1), frame_of(52, 75, {0.5, 0}), true), "");
    EXPECT_EQ(objection_to_packs(band_at(0, -3, 1), frame_of(52, 75, {0.5, 0}), true), "");
  }

  // A tenth of 52 may be cut off: at 45 degrees the offset may be (37.5 - 26 + 5.2) / sqrt 2 = 11.81 to either side.
  TEST(Packs, NamesThePlatenOfWhichMoreThanATenthIsCutOff)
  {
    EXPECT_EQ(objection_to_packs(band_at(-45, 11.8, 1), frame_52_75(), true), "");
    EXPECT_EQ(objection_to_packs(band_at(-45, -11.8, 1), frame_52_75(), true), "");
    expect_words(objection_to_packs(band_at(-45, 11.9, 1), frame_52_75(), true), {"% of the upper platen"});
    expect_words(objection_to_packs(band_at(-45, -11.9, 1), frame_52_75(), true), {"% of the lower platen"});
    // 20 along the normal is 28.28 along the platen, of which 11.5 lie above it: 16.78 of 52.
    expect_words(objection_to_packs(band_at(-45, 20, 1), frame_52_75(), true), {"cuts off 32.28 % of the upper platen"});
    expect_words(objection_to_packs(band_at(0, 40, 1), frame_52_75(), true), {"100 % of the upper platen"});
  }

  // In a sample 1.5 times as wide as high, the diagonal joins the platens' far corners. At 45 degrees both platens are cut by (90
  // - 60)/2 of 90.
  TEST(Packs, DiagonalOfAWideSampleDoesNotSeparatePacks)
  {
    const std::string reasons = objection_to_packs(band_at(-45, 0, 1.4), frame_of(90, 60, {0.5, -0.5}), true);
    expect_words(reasons, {"16.67 % of the upper platen"});
    expect_words(reasons, {"16.67 % of the lower platen"});
    expect_words(reasons, {"1.4 of the platen's travel, more than 1.2"});
  }

  TEST(Packs, PacksMoveAsThePlatensDo)
  {
    EXPECT_EQ(objection_to_packs(band_at(-45, 0, 1.2), frame_52_75(), true), "");
    expect_words(objection_to_packs(band_at(-45, 0, 1.21), frame_52_75(), true), {"more than 1.2"});
    expect_words(objection_to_packs(band_at(-45, 0, -1), frame_52_75(), true), {"part at 180 degrees to the platen's travel"});
    EXPECT_EQ(objection_to_packs(band_at(-26, 0, 1), frame_52_75(), true), "");
    expect_words(objection_to_packs(band_at(-24, 0, 1), frame_52_75(), true), {"its sides part at 21 degrees"});
    expect_words(objection_to_packs(band_at(-45, 0, 1), frame_52_75(), false), {"not converged"});
  }

  TEST(Packs, VerdictOfTheDetectionHasTheReasons)
  {
    const SampleFrame tall = frame_52_75();
    const BandReport  zone = find_bands(grain_field(tall, {{-45, 5, 1, 0.9, 8}}, 0.03, 1), tall);
    ASSERT_EQ(zone.bands.size(), 1u);
    EXPECT_TRUE(zone.bands[0].between_packs());
    expect_words(zone.verdict, {"one band between two packs; no further band"});

    const SampleFrame wide     = frame_of(90, 60, {0.5, -0.5});
    const BandReport  diagonal = find_bands(grain_field(wide, {{-36, 5, 0, 1.35, 8}}, 0.03, 2), wide);
    ASSERT_EQ(diagonal.bands.size(), 1u);
    EXPECT_FALSE(diagonal.bands[0].between_packs());
    expect_words(diagonal.verdict, {"one band, no zone between two packs: "});
    expect_words(diagonal.verdict, {"more than 1.2"});
  }

  // A Cosserat continuum shows this beside its band: a smooth rotation of the packs, which a tanh of a third of the sample's
  // width fits. In its middle it shears 0.27/(2 x 14) = 0.0096 of the travel per d; the sample shears 1/75 = 0.0133 on average.
  TEST(Packs, TransitionThatShearsLessThanTheSampleIsNotABand)
  {
    const SampleFrame frame  = frame_52_75();
    const BandReport  report = find_bands(node_field(frame, {{-46, 9, 0, 1.1, 9}, {37, 14, -0.7, -0.27, 12}}, 40, 56), frame);
    EXPECT_EQ(report.bands.size(), 1u) << report.verdict;
    expect_words(report.verdict, {"it shears less than the sample does on average"});
    // The same jump over a third of the width is a band: 0.27/(2 x 4) = 0.034.
    EXPECT_EQ(find_bands(node_field(frame, {{-46, 5, 0, 1.1, 9}, {37, 4, -0.7, -0.27, 12}}, 40, 56), frame).bands.size(), 2u);
  }

  TEST(Packs, CrossingPairRemainsTwoBands)
  {
    const SampleFrame frame  = frame_of(52, 75, {0, -0.7});
    const BandReport  report = find_bands(grain_field(frame, {{55, 5, 0, -0.5, 8}, {-57, 5, 0, 0.5, 8}}, 0.03, 3), frame);
    EXPECT_EQ(report.bands.size(), 2u) << report.verdict;
    expect_words(report.verdict, {"two bands"});
  }
} // namespace
