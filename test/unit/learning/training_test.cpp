// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/learning/training.hpp"

#include "coarse_map_nav/learning/torch_predictor.hpp"
#include "coarse_map_nav/learning/training_log.hpp"

#include <fstream>
#include <sstream>

#include "file_fixture.hpp"
#include "learning_examples.hpp"
#include <gmock/gmock.h>

namespace cmn {
namespace {

using ::testing::HasSubstr;

/// Two epochs of three steps.
TrainingJob short_job(const std::string& data, const std::string& out) {
  TrainingJob job;
  job.data = data;
  job.out = out;
  job.params.batch = 4;
  job.params.epochs = 2;
  job.params.learning_rate = 1e-3;
  return job;
}

std::string bytes_of(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream{path, std::ios::binary}.rdbuf();
  return bytes.str();
}

void expect_same(const std::vector<EpochRow>& a, const std::vector<EpochRow>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].epoch, b[i].epoch);
    EXPECT_EQ(a[i].train_loss, b[i].train_loss);
    EXPECT_EQ(a[i].validation_loss, b[i].validation_loss);
    EXPECT_EQ(a[i].average_precision, b[i].average_precision);
    EXPECT_EQ(a[i].learning_rate, b[i].learning_rate);
  }
}

TEST(Training, LossFallsOnATinySet) {
  const std::string data = toy_folder(8);
  for (const char* network : {"wedge", "cmn"}) {
    SCOPED_TRACE(network);
    TrainingJob job = short_job(data, fresh_folder(network));
    job.params.network = network;
    job.params.epochs = std::string{network} == "wedge" ? 20 : 5;
    job.params.patience = 100;
    const TrainingOutcome outcome = train(job);
    ASSERT_TRUE(outcome.is_finished);
    EXPECT_LT(outcome.rows.back().train_loss, 0.7 * outcome.rows.front().train_loss);
    EXPECT_THAT(bytes_of(job.out + "/log.csv"), HasSubstr("\n4,"));
    EXPECT_THAT(bytes_of(job.out + "/log.svg"), HasSubstr("validation"));
  }
}

TEST(Training, LeavesAModelThatThePredictorRuns) {
  TrainingJob job = short_job(toy_folder(12), fresh_folder("out"));
  train(job);
  const auto predictor = load_predictor(job.out + "/model.pt");
  ExampleSet test{job.data, Split::kTest};
  const PredictionScores scores = evaluate_predictor(*predictor, test, 5, 1);
  EXPECT_EQ(scores.examples, 5U);
  EXPECT_EQ(scores.near.in_sight.count(), 5.0 * 128 * 128);
  EXPECT_EQ(scores.wide.in_sight.count(), 5.0 * 64 * 64);
  EXPECT_THAT(score_text(scores.near), HasSubstr("AP_free="));
}

TEST(Training, IsTheSameFromTheSameSeedAndAnotherFromAnother) {
  const std::string data = toy_folder(12);
  const TrainingJob first = short_job(data, fresh_folder("first"));
  const TrainingJob second = short_job(data, fresh_folder("second"));
  TrainingJob third = short_job(data, fresh_folder("third"));
  third.seed = 2;
  const TrainingOutcome expected = train(first);
  expect_same(train(second).rows, expected.rows);
  EXPECT_EQ(bytes_of(first.out + "/model.pt"), bytes_of(second.out + "/model.pt"));
  EXPECT_NE(train(third).rows[0].train_loss, expected.rows[0].train_loss);
}

TEST(Training, StoppedAfterAnyStepItGoesOnExactly) {
  const std::string data = toy_folder(12);
  for (const char* schedule : {"constant", "cosine"}) {
    SCOPED_TRACE(schedule);
    TrainingJob whole = short_job(data, fresh_folder("whole"));
    whole.params.schedule = schedule;
    const TrainingOutcome expected = train(whole);
    TrainingJob pieces = short_job(data, fresh_folder("pieces"));
    pieces.params.schedule = schedule;
    int stops = 0;
    for (bool is_finished = false; !is_finished; ++stops) {
      int asked = 0;
      pieces.should_stop = [&asked] { return asked++ >= 1; };  // a step a run
      const TrainingOutcome outcome = train(pieces);
      is_finished = outcome.is_finished;
      if (is_finished) {
        expect_same(outcome.rows, expected.rows);
      }
      ASSERT_LT(stops, 20);
    }
    EXPECT_GE(stops, 5);
    EXPECT_EQ(bytes_of(whole.out + "/model.pt"), bytes_of(pieces.out + "/model.pt"));
  }
}

TEST(Training, KilledItGoesOnFromItsLastCheckpoint) {
  const std::string data = toy_folder(12);
  const TrainingJob whole = short_job(data, fresh_folder("whole"));
  const TrainingOutcome expected = train(whole);
  TrainingJob killed = short_job(data, fresh_folder("killed"));
  killed.checkpoint_batches = 1;
  struct Kill {};
  int steps = 0;
  killed.tell = [&steps](const TrainingProgress&) {
    if (++steps == 5) {
      throw Kill{};
    }
  };
  EXPECT_THROW(train(killed), Kill);
  expect_same(train(killed).rows, expected.rows);
}

TEST(Training, EndsWhenValidationGetsNoBetter) {
  TrainingJob job = short_job(toy_folder(12), fresh_folder("out"));
  job.params.epochs = 50;
  job.params.patience = 1;
  job.params.learning_rate = 0.3;  // far too high
  const TrainingOutcome outcome = train(job);
  EXPECT_TRUE(outcome.is_finished);
  EXPECT_LT(outcome.rows.size(), 50U);
}

TEST(Training, StartsFromTheWeightsOfAnother) {
  const std::string data = toy_folder(12);
  TrainingJob first = short_job(data, fresh_folder("first"));
  first.params.epochs = 6;
  const double reached = train(first).rows.back().validation_loss;
  TrainingJob second = short_job(data, fresh_folder("second"));
  second.start_from = first.out + "/checkpoint.pt";
  second.seed = 7;
  second.params.epochs = 1;
  second.params.learning_rate = 1e-7;
  EXPECT_NEAR(train(second).rows.back().validation_loss, reached, 0.05 * reached);
  TrainingJob other = short_job(data, fresh_folder("other"));
  other.start_from = second.start_from;
  other.params.network = "cmn";
  EXPECT_THAT(error_of([&] { train(other); }), HasSubstr("is a checkpoint of another network"));
}

TEST(Training, RefusesACheckpointThatIsNotItsOwn) {
  TrainingJob job = short_job(toy_folder(4), fresh_folder("out"));
  job.params.epochs = 1;
  train(job);
  job.seed = 3;
  EXPECT_THAT(error_of([&] { train(job); }),
              HasSubstr("belongs to a training with other settings"));
  std::ofstream{job.out + "/checkpoint.pt"} << "garbage";
  EXPECT_THAT(error_of([&] { train(job); }), HasSubstr("is no checkpoint, or is damaged"));
}

TEST(Training, NamesWhatCannotBeReadOrWritten) {
  TrainingJob job = short_job("/nowhere", fresh_folder("out"));
  EXPECT_THAT(error_of([&] { train(job); }), HasSubstr("/nowhere: is no folder"));
  job = short_job(toy_folder(4), "/nowhere");
  EXPECT_THAT(error_of([&] { train(job); }), HasSubstr("cannot be written"));
}

TEST(TrainingLog, LeavesOutWhatANetworkDoesNotState) {
  EpochRow row;
  row.epoch = 1;
  row.train_loss = 0.5;
  row.wide_average_precision = std::nan("");
  EXPECT_THAT(training_csv({row}),
              HasSubstr("\n1,0,0,0.500000,0.000000,0.00000,0.00000,0.00000,\n"));
  EXPECT_THAT(training_plot({row}, "title"), ::testing::Not(HasSubstr("wide")));
}

}  // namespace
}  // namespace cmn
