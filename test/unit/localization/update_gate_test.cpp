// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/localization/update_gate.hpp"

#include <gtest/gtest.h>

namespace cmn {
namespace {

const Pose2 kHere{1.0, 2.0, 0.3};

TEST(UpdateGate, TakesOneLookAtTheBeginningAndOneAfterEachAction) {
  UpdateGate gate{{}};
  EXPECT_TRUE(gate.is_due(1.0, kHere));
  EXPECT_FALSE(gate.is_due(1.1, kHere));
  EXPECT_TRUE(gate.action_ended(7, 2.0));
  EXPECT_TRUE(gate.is_waiting());
  EXPECT_FALSE(gate.is_due(2.0, kHere)) << "no newer than the end";
  EXPECT_EQ(gate.action_id(), 0U);
  EXPECT_TRUE(gate.is_due(2.1, kHere));
  EXPECT_EQ(gate.action_id(), 7U);
  EXPECT_FALSE(gate.is_waiting());
  EXPECT_FALSE(gate.is_due(2.2, kHere));
}

TEST(UpdateGate, KnowsARepeatedAnswerFromAnotherEnd) {
  UpdateGate gate{{}};
  gate.is_due(1.0, kHere);
  EXPECT_TRUE(gate.action_ended(7, 2.0));
  EXPECT_TRUE(gate.action_ended(7, 2.0)) << "no look has come yet";
  EXPECT_TRUE(gate.is_due(2.1, kHere));
  EXPECT_FALSE(gate.action_ended(7, 2.0));
  EXPECT_FALSE(gate.is_waiting());
  EXPECT_FALSE(gate.is_due(2.2, kHere));
  EXPECT_TRUE(gate.action_ended(7, 3.0)) << "ended again, at another time: another action";
  EXPECT_TRUE(gate.is_due(3.1, kHere));
}

TEST(UpdateGate, ByMotionTakesALookAfterTheDistanceOrAQuarterTurn) {
  UpdateGateParams params;
  params.update_on = "motion";
  UpdateGate gate{params};
  EXPECT_TRUE(gate.is_due(1.0, {}));
  EXPECT_FALSE(gate.is_due(1.1, {0.1, 0.0, 0.0}));
  EXPECT_TRUE(gate.is_due(1.2, {0.16, 0.0, 0.0}));
  EXPECT_FALSE(gate.is_due(1.3, {0.16, 0.0, 0.5}));
  EXPECT_TRUE(gate.is_due(1.4, {0.16, 0.0, 1.5}));
}

TEST(UpdateGate, AfterAResetTheNextLookCountsWhateverCameBefore) {
  UpdateGate gate{{}};
  gate.is_due(1.0, kHere);
  gate.reset();
  EXPECT_TRUE(gate.is_due(1.1, kHere));
}

TEST(UpdateGate, NoticesTimeThatWentBackAndForgetsTheActionThatEndedLater) {
  UpdateGate gate{{}};
  EXPECT_FALSE(gate.time_jumped_back(10.0));
  gate.is_due(10.0, kHere);
  gate.action_ended(3, 20.0);
  EXPECT_FALSE(gate.time_jumped_back(9.5)) << "messages may swap places";
  EXPECT_TRUE(gate.is_waiting());
  EXPECT_TRUE(gate.time_jumped_back(1.0));
  EXPECT_FALSE(gate.is_waiting());
  EXPECT_FALSE(gate.time_jumped_back(1.1));
}

TEST(UpdateGate, ABagThatIsPlayedAgainEndsItsActionsAgain) {
  UpdateGate gate{{}};
  for (int play = 0; play < 2; ++play) {
    gate.time_jumped_back(1.0);
    gate.is_due(1.0, kHere);
    EXPECT_TRUE(gate.action_ended(3, 2.0));
    gate.time_jumped_back(2.1);
    EXPECT_TRUE(gate.is_due(2.1, kHere));
  }
}

}  // namespace
}  // namespace cmn
