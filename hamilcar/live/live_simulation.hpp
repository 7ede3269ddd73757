// An interactively driven car: the simulation, the filter of the user's controls, and the frames that pages show.
//
// It is built on any thread (files, Initial Process, scene), then stepped by one; another may read constants and frames. It has no
// clock, so the same controls give the same path, bit for bit, at any pace and frame rate.
#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hamilcar/live/control_filter.hpp"
#include "hamilcar/live/course_judge.hpp"
#include "hamilcar/live/triple_buffer.hpp"
#include "hamilcar/run/channels.hpp"

namespace hamilcar::live {

// What to drive: ids of the catalog and the road's friction [1].
struct LoadRequest {
    std::string vehicle, road;
    double friction = 1;
};

// A controller that the driver may switch off; one that is commanded from outside is none.
struct Aid {
    std::size_t controller;  // its place in the vehicle's file
    std::string keyword, meaning;
};

// Some of a car's aids, by their places in its file; a controller behind so many cannot be switched.
using AidSet = std::bitset<32>;

// Controls with the page that sent them and that page's sequence number.
struct ReceivedControls {
    std::uint32_t page = 0, sequence = 0;
    Controls controls;
};

// What a page shows of one instant.
struct Frame {
    double time = 0;  // [s]
    std::uint32_t page = 0, sequence = 0;
    double x = 0, y = 0;        // of the vehicle's origin, ground axes [m]
    std::vector<float> values;  // of every channel
    CourseRun run;              // through the course, if there is one
};

class LiveSimulation {
public:
    // The scenario defines start, road and solver; its inputs, duration and controllers_off are ignored, and a course overrides its
    // start. Vehicles with power units are driven by these. Throws as Simulation and CourseJudge do.
    LiveSimulation(std::uint32_t number, const LoadRequest& request, const VehicleDescription& vehicle,
                   ScenarioDescription scenario, std::optional<TestCourse> course = {});

    // Constants, for any thread.
    std::uint32_t number() const { return number_; }
    const LoadRequest& request() const { return request_; }
    const std::vector<Channel>& channels() const { return channels_; }
    const std::string& scene() const { return scene_; }  // JSON
    const DrivenCar& car() const { return simulation_.driven_car(); }
    const std::vector<Aid>& aids() const { return aids_; }
    const TestCourse* course() const { return judge_ ? &judge_->course() : nullptr; }
    double step() const { return simulation_.scenario().solver.step; }
    const VehicleDescription& vehicle() const { return simulation_.vehicle(); }
    const PlaneRoad<double>& road() const { return simulation_.model().road; }
    const Surface* surface() const { return simulation_.surface().get(); }
    bool uneven() const { return simulation_.scenario().road.is_uneven(); }

    // For the thread that steps.
    std::optional<End> advance(const ReceivedControls& received);
    void reset();                                          // to the start, bit for bit; aids stay on or off
    void switch_off(const AidSet& off);                    // these of the aids, all others on
    void publish_frame(const ReceivedControls& received);  // for the thread that shows
    double time() const { return simulation_.time(); }
    long steps_taken() const { return simulation_.steps_taken(); }
    long steps_in(double duration) const;      // at least one
    std::span<const double> channel_values();  // of all channels, now
    const State<double>& state() const { return simulation_.state(); }

    // For the thread that shows.
    TripleBuffer<Frame>& frames() { return frames_; }

private:
    bool is_due(double interval) const { return steps_taken() % steps_in(interval) == 0; }
    double shaft_ratio();
    void apply(const Input<double>& now);

    std::uint32_t number_;
    LoadRequest request_;
    std::optional<CourseJudge> judge_;
    Simulation simulation_;
    ControlFilter filter_;
    MeasuredSpeeds speeds_;
    std::vector<Aid> aids_;
    AidSet off_;
    std::vector<Channel> channels_;
    std::vector<double> values_;  // of the channels, at step `values_step_`
    long values_step_ = -1;
    std::string scene_;
    Snapshot start_;
    TripleBuffer<Frame> frames_;
};

}  // namespace hamilcar::live
