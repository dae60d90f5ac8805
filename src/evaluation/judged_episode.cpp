// Copyright (c) 2026, the coarse_map_nav authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_map_nav/evaluation/judged_episode.hpp"

#include "coarse_map_nav/data/random.hpp"
#include "coarse_map_nav/evaluation/action_times.hpp"
#include "coarse_map_nav/evaluation/looks.hpp"
#include "coarse_map_nav/evaluation/sight_score.hpp"
#include "coarse_map_nav/localization/belief_filter.hpp"
#include "coarse_map_nav/localization/given_pose.hpp"
#include "coarse_map_nav/mapping/regions.hpp"
#include "coarse_map_nav/navigator.hpp"
#include "coarse_map_nav/simulation/planar_sensors.hpp"
#include "coarse_map_nav/simulation/step_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace cmn {
namespace {

constexpr double kDrivableCell_m = 0.1;
constexpr int kCropCells = 3;

CoarseMap drivable_map(const World& world, const CoarseMap& extent, double radius_m) {
  const int width = static_cast<int>(extent.width() * extent.resolution() / kDrivableCell_m);
  const int height = static_cast<int>(extent.height() * extent.resolution() / kDrivableCell_m);
  Grid<std::uint8_t> occupied{width, height, 1};
  CoarseMap map{occupied, kDrivableCell_m, extent.T_map_grid()};
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = world.is_disc_free(map.center_of(occupied.cell_at(i)), radius_m) ? 0 : 1;
  }
  return largest_region({std::move(occupied), kDrivableCell_m, extent.T_map_grid()}).map;
}

/// Each cell cut into as many as bring it near `cell_m`, at the true scale.
CoarseMap metric(const CoarseMap& drawing, double scale, double cell_m) {
  const double true_cell_m = drawing.resolution() / scale;
  const int cuts = std::max(1, static_cast<int>(std::lround(true_cell_m / cell_m)));
  Pose2 T_map_grid = drawing.T_map_grid();
  T_map_grid.x /= scale;
  T_map_grid.y /= scale;
  return {cut(drawing, cuts).occupied(), true_cell_m / cuts, T_map_grid};
}

/// CMN's "grid observation": the crop of the map about the robot, in its axes. `scale`: metres of
/// the map a metre in the world.
LocalOccupancy true_crop(const CoarseMap& map, double scale, const Pose2& T_map_robot) {
  LocalOccupancy crop{kCropCells, map.resolution() / scale};
  const Cell home = map.cell_of(T_map_robot.position());
  const int quarters = nearest_quarter(T_map_robot.yaw - map.T_map_grid().yaw);
  for (int iy = 0; iy < kCropCells; ++iy) {
    for (int ix = 0; ix < kCropCells; ++ix) {
      const Cell c = home + turned(Cell{ix - kCropCells / 2, iy - kCropCells / 2}, quarters);
      crop.occupancy[crop.index_of(ix, iy)] = map.is_occupied(c) ? 1.0F : 0.0F;
      crop.confidence[crop.index_of(ix, iy)] = 1.0F;
    }
  }
  return crop;
}

/// What a method has for a map, where the truth lies on it, and its estimates in the world.
struct GivenMap {
  CoarseMap map;
  std::function<Pose2(const Pose2&)> from_world;
  std::function<Pose2(const Pose2&)> to_world;
};

GivenMap given_map(const Scene& scene, const Drawing& drawing, const Method& method,
                   double step_m) {
  if (method.plans_on_world) {
    const auto same = [](const Pose2& pose) { return pose; };
    return {scene.drivable, same, same};
  }
  const auto on_drawing = [drawing](const Pose2& pose) { return drawing.world_to_map(pose); };
  const auto in_world = [drawing](const Pose2& pose) { return drawing.map_to_world(pose); };
  const CoarseMap map = largest_region(drawing.map()).map;
  if (!method.has_metric_map) {
    return {map, on_drawing, in_world};
  }
  const double scale = drawing.scale();
  return {metric(map, scale, step_m),
          [on_drawing, scale](const Pose2& pose) {
            const Pose2 nominal = on_drawing(pose);
            return Pose2{nominal.x / scale, nominal.y / scale, nominal.yaw};
          },
          [in_world, scale](const Pose2& pose) {
            return in_world({scale * pose.x, scale * pose.y, pose.yaw});
          }};
}

Pose2 estimated_pose(const Localization& at, const CoarseMap& map) {
  return map.T_map_grid() * Pose2{map.resolution() * at.position_cells.x,
                                  map.resolution() * at.position_cells.y, yaw(at.estimate.heading)};
}

std::unique_ptr<Localizer> localizer_for(const Method& method, const Task& task,
                                         const CoarseMap& map, const LocalizationParams& params,
                                         const Pose2& T_map_start) {
  if (method.knows_pose) {
    return std::make_unique<GivenPose>(map);
  }
  std::unique_ptr<Localizer> localizer = make_localizer(map, params);
  if (method.knows_heading || task.knows_heading) {
    localizer->reset_heading(nearest_heading(T_map_start.yaw - map.T_map_grid().yaw));
  }
  return localizer;
}

std::unique_ptr<SceneSensors> sensors_in(const Scene& scene, const LidarParams& lidar,
                                         std::uint32_t seed) {
  return scene.sensors ? scene.sensors(lidar, seed)
                       : std::make_unique<PlanarSensors>(scene.world, lidar, seed);
}

Action any_action(std::mt19937_64& rng, double step_m) {
  constexpr std::array<ActionType, 3> kActions{ActionType::kMoveForward, ActionType::kTurnLeft,
                                               ActionType::kTurnRight};
  return {kActions[draw_index(rng, kActions.size())], step_m};
}

bool is_an_end(NavigationState state) {
  return state == NavigationState::kReached || state == NavigationState::kFailed;
}

/// Seed of where a kidnapped robot is put down.
constexpr std::uint64_t kDropSalt = 0x6b69646e6170706dU;

}  // namespace

Scene::Scene(std::string scene_name, CoarseMap world_map, std::optional<CoarseMap> wall_map,
             const JudgeParams& judge)
    : name{std::move(scene_name)},
      map{std::move(world_map)},
      walls{std::move(wall_map)},
      world{map},
      routes{world, map, judge.simulation.robot.radius_m},
      drivable{drivable_map(world, map, judge.simulation.robot.radius_m)} {}

std::optional<Route> sample_route(const Scene& scene, const Drawing& drawing,
                                  const JudgeParams& judge, std::uint64_t seed) {
  std::mt19937_64 rng{seed};
  const CoarseMap map = largest_region(drawing.map()).map;
  const auto is_free_on_drawing = [&](Point2 goal_world) {
    return map.is_free(map.cell_of(drawing.world_to_map(goal_world)));
  };
  return scene.routes.sample(judge.least_way_m, judge.most_way_m, is_free_on_drawing, rng);
}

EpisodeRow run_judged_episode(const Scene& scene, const Task& task, const Drawing& drawing,
                              const Route& route, const Method& method, NavigatorParams params,
                              const JudgeParams& judge, const EpisodeKey& key,
                              const std::function<double()>& clock_s,
                              const EpisodeRecorder& recorder,
                              std::shared_ptr<OccupancyPredictor> predictor) {
  std::mt19937_64 rng{key.seed};
  const auto seed = [&rng] { return static_cast<std::uint32_t>(rng()); };
  params.localization.seed = seed();
  params.planning.seed = seed();
  // With the true crop nothing is left to grow: it is of the drawing.
  if (task.draws_middle() && task.observation != ObservationKind::kTrueCrop) {
    params.perception.grow_m = judge.simulation.robot.radius_m;
  }
  SimulationParams simulation = judge.simulation;
  simulation.robot.sliding |= task.has_paper_setting && judge.papers_robot_slides;
  if (task.has_paper_setting && task.observation == ObservationKind::kColorPanorama &&
      judge.papers_robot_knows_heading) {
    simulation.robot.turn_noise = simulation.robot.turn_bias = 0.0;
    // Nothing is left for walls, blurred ones, to say about it.
    params.localization.scaled.compass.enabled = false;
    params.perception.rolling.align.enabled = false;
  }
  if (task.observation == ObservationKind::kForward) {
    simulation.lidar.field_of_view_deg = 180.0;
    simulation.lidar.beams = simulation.lidar.beams / 2 + 1;
  }
  StepDrive robot{scene.world, simulation.robot, route.T_world_start, rng()};
  const std::unique_ptr<SceneSensors> sensors = sensors_in(scene, simulation.lidar, seed());
  Looks looks{*sensors, params.perception};
  SightScore sight{scene.world};
  ActionTimes times{simulation.robot, params.motion};

  const GivenMap given = given_map(scene, drawing, method, params.planning.step_m);
  MeasurementModelParams& measurement = params.localization.measurement;
  if (method.has_metric_map) {
    measurement.window_m = measurement.window_cells() * given.map.resolution();
  } else if (task.observation == ObservationKind::kTrueCrop &&
             measurement.window_cells() == kCropCells) {
    measurement.window_m = kCropCells * drawing.map().resolution() / drawing.scale();
  }
  const Pose2 goal = given.from_world({route.goal_world.x, route.goal_world.y, 0.0});
  std::unique_ptr<Localizer> owned = localizer_for(method, task, given.map, params.localization,
                                                   given.from_world(route.T_world_start));
  auto* told = dynamic_cast<GivenPose*>(owned.get());
  Navigator navigator{given.map, params, std::move(owned), std::move(predictor)};

  Judge the_judge{judge, route, key, task.kidnaps};
  EpisodeRow& row = the_judge.row();
  if (const auto reason = navigator.planner().set_goal(goal.position())) {
    row.end = "goal refused";
    return row;
  }
  const auto kidnap = [&] {
    const auto there =
        sample_drop(scene.routes, judge, robot.truth(), route.goal_world, key.seed ^ kDropSalt);
    if (there) {
      the_judge.drop(robot, *there);
    } else {
      the_judge.give_up_kidnapping();
    }
    return there.has_value();
  };
  MotionOutcome last_outcome = MotionOutcome::kSucceeded;
  double thinking_s = 0.0;
  int steps = 0;
  the_judge.look_at(robot);
  while (true) {
    const Pose2 T_map_true = given.from_world(robot.truth());
    const SensorData data = looks.at(robot.truth(), row.simulated_s);
    if (told != nullptr) {
      told->place(T_map_true);
    }
    const double before_s = clock_s();
    Decision decision = task.observation == ObservationKind::kTrueCrop
                            ? navigator.step(*data.scan,
                                             true_crop(drawing.map(), drawing.scale(),
                                                       drawing.world_to_map(robot.truth())),
                                             robot.T_odom_robot(), last_outcome)
                            : navigator.step(data, robot.T_odom_robot(), last_outcome);
    thinking_s += clock_s() - before_s;
    ++steps;
    const Localization at = navigator.localizer().localization();
    if (!decision.is_pivot) {
      the_judge.look_at(at, given.map, T_map_true, told == nullptr);
    }
    if (scene.sensors && !decision.is_pivot) {
      const LocalOccupancy& local_map = navigator.local_map();
      sight.add(local_map.size > 0 ? local_map : navigator.seen(), robot.truth());
    }
    if (recorder && !decision.is_pivot) {
      const Pose2 T_map_estimate = estimated_pose(at, given.map);
      recorder({robot.truth(), at, T_map_true, T_map_estimate, given.to_world(T_map_estimate),
                robot.collisions(), given.map, goal.position(), decision, navigator.local_map(),
                navigator.seen(), robot.T_odom_robot(), navigator});
    }
    if (decision.state == NavigationState::kReached) {
      the_judge.hear_reached(robot);
    }
    const bool is_at_horizon = row.actions >= params.planning.max_actions;
    row.end = decision.state == NavigationState::kReached ? "reached"
              : is_at_horizon                             ? "horizon"
                                                          : "failed";
    const bool is_over = is_an_end(decision.state);
    if (is_over && !is_at_horizon && the_judge.is_before_drop() && kidnap()) {
      navigator.planner().set_goal(goal.position());
      last_outcome = MotionOutcome::kSucceeded;
      continue;
    }
    if (is_over) {
      if (!method.ends_by_judge) {
        break;
      }
      navigator.planner().set_goal(goal.position());
      decision.action = any_action(rng, params.planning.step_m);
      if (judge.forgets_at_goal) {
        navigator.localizer().reset_heading(at.estimate.heading);
      }
    }
    if (is_at_horizon || (method.ends_by_judge && row.is_success)) {
      row.end = row.is_success ? "success" : "horizon";
      break;
    }
    last_outcome = robot.carry_out(decision.action);
    if (decision.is_pivot) {
      the_judge.count_pivot(times.of(decision.action));
    } else {
      the_judge.count_action(decision.action, times.of(decision.action));
    }
    the_judge.look_at(robot);
    if (the_judge.is_time_to_kidnap(robot)) {
      kidnap();
    }
  }
  the_judge.end();
  row.free_iou = sight.free_iou();
  row.obstacle_iou = sight.obstacle_iou();
  row.step_ms = 1000.0 * thinking_s / steps;
  return row;
}

}  // namespace cmn
