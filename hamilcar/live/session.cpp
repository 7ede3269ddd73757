#include "hamilcar/live/session.hpp"

#include <exception>
#include <filesystem>

namespace hamilcar::live {

Session::Session(Garage garage, const Wish& first, std::string recordings_folder)
    : garage_(std::move(garage)),
      folder_(std::move(recordings_folder)),
      ride_(build(first, cars_)),
      stepper_(ride_, bell_) {}

void Session::reset() {
    stepper_.order([](Orders& orders) { orders.reset = true; });
}

void Session::pause(bool on) {
    stepper_.order([on](Orders& orders) { orders.pause = on; });
}

void Session::set_driven(bool on) {
    stepper_.order([on](Orders& orders) { orders.driven = on; });
}

void Session::set_pace(double pace) {
    stepper_.order([pace](Orders& orders) { orders.pace = pace; });
}

void Session::load(const Wish& wish, std::uint32_t page) {
    next_ = {wish, page};
    if (!making_) make_next();
}

void Session::record(bool on, std::uint32_t page) {
    recording_wanted_ = on;
    recording_page_ = page;
    settle_recording();
}

RecordingStatus Session::recording() const {
    if (tape_ != Tape::running) return {};
    return {recording_->path(), recording_->seconds(), recording_->lost_rows()};
}

bool Session::attend() {
    std::vector<std::function<void()>> answers;
    {
        const std::lock_guard lock(answers_mutex_);
        answers.swap(answers_);
    }
    for (const auto& answer : answers) answer();
    for (std::shared_ptr<void>& thing : stepper_.take_back()) put_away(std::move(thing));
    if (tape_ == Tape::running && recording_->failed()) {
        notices_.push_back({recording_page_, recording_->failure()});
        recording_wanted_ = false;
    }
    settle_recording();
    return std::exchange(changed_, false);
}

void Session::send_for(std::function<std::function<void()>()> job) {
    workshop_.post([this, job = std::move(job)] {
        std::function<void()> answer = job();
        {
            const std::lock_guard lock(answers_mutex_);
            answers_.push_back(std::move(answer));
        }
        bell_.ring();
    });
}

std::shared_ptr<Ride> Session::build(const Wish& wish, std::uint32_t number) const {
    auto [vehicle, scenario] = garage_.open(wish);
    std::optional<TestCourse> course;
    if (garage_.course) course = garage_.course(wish.road, vehicle);
    return std::make_shared<Ride>(number, wish, vehicle, std::move(scenario), std::move(course));
}

void Session::make_next() {
    making_ = true;
    const auto [wish, page] = *std::exchange(next_, std::nullopt);
    send_for([this, wish = wish, page = page, number = ++cars_]() -> std::function<void()> {
        std::shared_ptr<Ride> ride;
        std::string problem;
        try {
            ride = build(wish, number);
        } catch (const std::exception& error) {
            problem = error.what();
        }
        return [this, ride, page, problem] {
            making_ = false;
            if (!ride) notices_.push_back({page, problem});
            if (ride && !next_) {
                ride_ = ride;
                changed_ = true;
                stepper_.order([&](Orders& orders) { orders.ride = ride; });
            }
            if (next_) make_next();
        };
    });
}

// One step toward what is wanted; the next one follows when this one is done.
void Session::settle_recording() {
    if (tape_ == Tape::none && recording_wanted_ && !making_) {  // of the car that is to come, if one is
        tape_ = Tape::opening;
        open_recording();
    } else if (tape_ == Tape::running && !recording_wanted_) {
        tape_ = Tape::closing;
        stepper_.order([](Orders& orders) { orders.stop_recording = true; });
    }
}

void Session::open_recording() {
    send_for([this, ride = ride_]() -> std::function<void()> {
        std::shared_ptr<Recording> recording;
        std::string problem;
        try {
            const std::string vehicle = std::filesystem::path(ride->wish().vehicle).stem().string();
            recording = std::make_shared<Recording>(new_recording_file(folder_, vehicle), ride);
        } catch (const std::exception& error) {
            problem = error.what();
        }
        return [this, recording, problem] {
            tape_ = recording ? Tape::running : Tape::none;
            recording_ = recording;
            if (recording) {
                stepper_.order([&](Orders& orders) { orders.recording = recording; });
            } else {
                recording_wanted_ = false;
                notices_.push_back({recording_page_, problem});
            }
        };
    });
}

// Cars are taken apart and files are closed in the workshop. A recording that comes back unasked has lost its car.
void Session::put_away(std::shared_ptr<void> thing) {
    const bool is_recording = thing == recording_;
    if (is_recording) {
        if (tape_ == Tape::running) recording_wanted_ = false;
        tape_ = Tape::closing;
        recording_.reset();
    }
    send_for([this, is_recording, thing = std::move(thing)]() mutable -> std::function<void()> {
        std::string problem;
        if (is_recording) problem = std::static_pointer_cast<Recording>(thing)->finish();
        thing.reset();
        return [this, is_recording, problem] {
            if (is_recording) tape_ = Tape::none;
            if (!problem.empty()) notices_.push_back({recording_page_, problem});
        };
    });
}

}  // namespace hamilcar::live
