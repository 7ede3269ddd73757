// A car on a road with somebody at the wheel: the simulation, the hands, and what is to be seen of it.
//
// Made on any thread (files, Initial Process, scene), then stepped by one; another may read what never changes, and frames.
// It has no clock, so the same controls give the same path, bit for bit, at whatever pace and however often it is shown.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hamilcar/live/course_judge.hpp"
#include "hamilcar/live/hands.hpp"
#include "hamilcar/live/newest.hpp"
#include "hamilcar/run/channels.hpp"

namespace hamilcar::live {

// What somebody wants to drive: ids of the garage, and the road's friction [1].
struct Wish {
    std::string vehicle, road;
    double friction = 1;
};

// Controls, whose they are, and their number in the order of that page.
struct Held {
    std::uint32_t page = 0, sequence = 0;
    Controls controls;
};

// One instant for the eye.
struct Frame {
    double time = 0;  // [s]
    std::uint32_t page = 0, sequence = 0;
    double x = 0, y = 0;        // of the vehicle's origin, ground axes [m]
    std::vector<float> values;  // of every channel
    CourseRun run;              // through the course, where there is one
};

class Ride {
public:
    // The scenario gives start, road and solver; its inputs and duration give way to the person, its start to a course's.
    // Vehicles with power units drive by these. Throws as Simulation and CourseJudge do.
    Ride(std::uint32_t number, const Wish& wish, const VehicleDescription& vehicle, ScenarioDescription scenario,
         std::optional<TestCourse> course = {});

    // What never changes, for any thread.
    std::uint32_t number() const { return number_; }
    const Wish& wish() const { return wish_; }
    const std::vector<Channel>& channels() const { return channels_; }
    const std::string& scene() const { return scene_; }  // JSON
    const DrivenCar& car() const { return simulation_.driven_car(); }
    const TestCourse* course() const { return judge_ ? &judge_->course() : nullptr; }
    double step() const { return simulation_.scenario().solver.step; }
    const VehicleDescription& vehicle() const { return simulation_.vehicle(); }
    const PlaneRoad<double>& road() const { return simulation_.model().road; }
    const Surface* surface() const { return simulation_.surface().get(); }
    bool uneven() const { return simulation_.scenario().road.is_uneven(); }

    // For the thread that steps.
    std::optional<End> advance(const Held& held);
    void reset();                 // to the start, to the bit
    void show(const Held& held);  // puts a frame where the other thread finds it
    double time() const { return simulation_.time(); }
    long steps_taken() const { return simulation_.steps_taken(); }
    long steps_in(double duration) const;  // at least one
    std::span<const double> observe();     // every channel, now
    const State<double>& state() const { return simulation_.state(); }

    // For the thread that shows.
    Newest<Frame>& frames() { return frames_; }

private:
    bool is_time(double interval) const { return steps_taken() % steps_in(interval) == 0; }
    double shaft_ratio();
    void obey(const Input<double>& now);

    std::uint32_t number_;
    Wish wish_;
    std::optional<CourseJudge> judge_;
    Simulation simulation_;
    Hands hands_;
    Felt felt_;
    std::vector<Channel> channels_;
    std::vector<double> values_;  // of the channels, at the step below
    long observed_ = -1;
    std::string scene_;
    Snapshot start_;
    Newest<Frame> frames_;
};

}  // namespace hamilcar::live
