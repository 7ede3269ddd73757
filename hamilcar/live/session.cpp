#include "hamilcar/live/session.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>

namespace hamilcar::live {

Session::Session(Catalog catalog, const LoadRequest& first, std::string recordings_folder, const RecordingQuota& quota)
    : catalog_(std::move(catalog)),
      folder_(std::move(recordings_folder)),
      quota_(quota),
      simulation_(build(first, cars_)),
      stepper_(simulation_, wake_up_) {}

void Session::reset() {
    stepper_.post([](Commands& commands) { commands.reset = true; });
}

void Session::pause(bool on) {
    stepper_.post([on](Commands& commands) { commands.pause = on; });
}

void Session::set_driven(bool on) {
    stepper_.post([on](Commands& commands) { commands.driven = on; });
}

void Session::set_pace(double pace) {
    stepper_.post([pace](Commands& commands) { commands.pace = pace; });
}

bool Session::switch_aid(std::string_view keyword, bool on) {
    const std::vector<Aid>& aids = simulation_->aids();
    const auto found = std::ranges::find(aids, keyword, &Aid::keyword);
    if (found == aids.end()) return false;
    aids_off_.set(found->controller, !on);
    stepper_.post([this](Commands& commands) { commands.aids_off = aids_off_; });
    return true;
}

std::vector<std::string> Session::switched_off() const {
    std::vector<std::string> keywords;
    for (const Aid& aid : simulation_->aids()) {
        if (aids_off_[aid.controller]) keywords.push_back(aid.keyword);
    }
    return keywords;
}

void Session::load(const LoadRequest& request, std::uint32_t page) {
    next_ = {request, page};
    if (!building_) build_next();
}

void Session::record(bool on, std::uint32_t page) {
    recording_wanted_ = on;
    recording_page_ = page;
    update_recording();
}

RecordingStatus Session::recording() const {
    if (recorder_ != RecorderState::running) return {};
    return {recording_->path(), recording_->seconds(), recording_->lost_rows()};
}

bool Session::update() {
    std::vector<std::function<void()>> completions;
    {
        const std::lock_guard lock(completions_mutex_);
        completions.swap(completions_);
    }
    for (const auto& completion : completions) completion();
    for (std::shared_ptr<void>& object : stepper_.take_released()) dispose_of(std::move(object));
    const bool failed = recorder_ == RecorderState::running && recording_->failed();
    if (failed) recording_wanted_ = false;  // why is told when it is closed
    update_recording();
    return std::exchange(changed_, false);
}

void Session::run_in_background(std::function<std::function<void()>()> job) {
    worker_.post([this, job = std::move(job)] {
        std::function<void()> completion = job();
        {
            const std::lock_guard lock(completions_mutex_);
            completions_.push_back(std::move(completion));
        }
        wake_up_.signal();
    });
}

std::shared_ptr<LiveSimulation> Session::build(const LoadRequest& request, std::uint32_t number) const {
    auto [vehicle, scenario] = catalog_.open(request);
    std::optional<TestCourse> course;
    if (catalog_.course) course = catalog_.course(request.road, vehicle);
    return std::make_shared<LiveSimulation>(number, request, vehicle, std::move(scenario), std::move(course));
}

void Session::build_next() {
    building_ = true;
    const auto [request, page] = *std::exchange(next_, std::nullopt);
    run_in_background([this, request = request, page = page, number = ++cars_]() -> std::function<void()> {
        std::shared_ptr<LiveSimulation> simulation;
        std::string problem;
        try {
            simulation = build(request, number);
        } catch (const std::exception& error) {
            problem = error.what();
        }
        return [this, simulation, page, problem] {
            building_ = false;
            if (!simulation) notices_.push_back({page, problem});
            if (simulation && !next_) {
                simulation_ = simulation;
                aids_off_.reset();
                changed_ = true;
                stepper_.post([&](Commands& commands) {
                    commands.simulation = simulation;
                    commands.aids_off.reset();  // was for the car before
                });
            }
            if (next_) build_next();
        };
    });
}

// Starts the next transition toward the wanted state; it is called again when that is complete.
void Session::update_recording() {
    if (recorder_ == RecorderState::none && recording_wanted_ && !building_) {  // waits for a car that is being built
        recorder_ = RecorderState::opening;
        open_recording();
    } else if (recorder_ == RecorderState::running && !recording_wanted_) {
        recorder_ = RecorderState::closing;
        stepper_.post([](Commands& commands) { commands.stop_recording = true; });
    }
}

void Session::open_recording() {
    run_in_background([this, simulation = simulation_]() -> std::function<void()> {
        std::shared_ptr<Recording> recording;
        std::string problem;
        try {
            const std::string vehicle = std::filesystem::path(simulation->request().vehicle).stem().string();
            recording = std::make_shared<Recording>(new_recording_file(folder_, vehicle, quota_), simulation, quota_);
        } catch (const std::exception& error) {
            problem = error.what();
        }
        return [this, recording, problem] {
            recorder_ = recording ? RecorderState::running : RecorderState::none;
            recording_ = recording;
            if (recording) {
                stepper_.post([&](Commands& commands) { commands.recording = recording; });
            } else {
                recording_wanted_ = false;
                notices_.push_back({recording_page_, problem});
            }
        };
    });
}

// Destroys cars and closes files in the background. A recording that is released without request has lost its car.
void Session::dispose_of(std::shared_ptr<void> object) {
    const bool is_recording = object == recording_;
    if (is_recording) {
        if (recorder_ == RecorderState::running) recording_wanted_ = false;
        recorder_ = RecorderState::closing;
        recording_.reset();
    }
    run_in_background([this, is_recording, object = std::move(object)]() mutable -> std::function<void()> {
        std::string problem;
        if (is_recording) problem = std::static_pointer_cast<Recording>(object)->finish();
        object.reset();
        return [this, is_recording, problem] {
            if (is_recording) recorder_ = RecorderState::none;
            if (!problem.empty()) notices_.push_back({recording_page_, problem});
        };
    });
}

}  // namespace hamilcar::live
