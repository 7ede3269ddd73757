#include "hamilcar/live/stepper.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <time.h>

#include <cerrno>
#include <utility>

namespace hamilcar::live {

namespace {

constexpr Nanoseconds millisecond = 1'000'000, second = 1'000'000'000;
constexpr Nanoseconds report_interval = 100 * millisecond, rest_interval = 5 * millisecond;
constexpr double frame_interval = 0.01;  // of real time [s]

Nanoseconds now() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * second + t.tv_nsec;
}

void sleep_until(Nanoseconds when) {
    const timespec t{.tv_sec = when / second, .tv_nsec = when % second};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {}
}

// Ahead of everything ordinary on the machine; where that is not allowed, as it comes. A lone processor is left to all.
void raise_priority() {
    const sched_param lowest_of_real_time{.sched_priority = sched_get_priority_min(SCHED_FIFO)};
    constexpr int ahead = -10;
    if (std::thread::hardware_concurrency() > 1 &&
        pthread_setschedparam(pthread_self(), SCHED_FIFO, &lowest_of_real_time) == 0) {
        return;
    }
    setpriority(PRIO_PROCESS, 0, ahead);  // of this thread alone, on Linux
}

}  // namespace

Stepper::Stepper(std::shared_ptr<Ride> ride, const Bell& bell)
    : bell_(bell),
      ride_(std::move(ride)),
      pacer_(ride_->step()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Stepper::hold(const Held& held) {
    held_.draft() = held;
    held_.publish();
}

std::vector<std::shared_ptr<void>> Stepper::take_back() {
    const std::lock_guard lock(box_);
    return std::exchange(put_back_, {});
}

const Progress& Stepper::progress() {
    progress_.fetch();
    return progress_.value();
}

Pause Stepper::paused() const {
    if (end_) return Pause::ended;
    if (!driven_) return Pause::nobody;
    return driver_pauses_ ? Pause::driver : Pause::none;
}

void Stepper::run(const std::stop_token& stop) {
    raise_priority();
    report();
    while (!stop.stop_requested()) {
        heed_orders();
        if (paused() == Pause::none) {
            step();
        } else {
            rest();
        }
    }
}

void Stepper::heed_orders() {
    const std::unique_lock lock(box_, std::try_to_lock);
    if (!lock.owns_lock() || !std::exchange(ordered_, false)) return;
    Orders orders = std::exchange(orders_, {});
    if (orders.ride) put_on_road(std::move(orders.ride));
    if (orders.reset) start_anew();
    if (orders.recording && &orders.recording->ride() != ride_.get()) put_back(std::move(orders.recording));
    if (orders.recording) recording_ = std::move(orders.recording);
    if (orders.stop_recording) put_back(std::move(recording_));  // one that came with it too: it was opened before
    if (orders.pause) driver_pauses_ = *orders.pause;
    if (orders.driven) driven_ = *orders.driven;
    if (orders.pace) pacer_.set_pace(*orders.pace, now());
    report();
    bell_.ring();
}

void Stepper::put_on_road(std::shared_ptr<Ride> ride) {
    put_back(std::move(recording_));
    put_back(std::exchange(ride_, std::move(ride)));
    end_.reset();
    pacer_ = Pacer(ride_->step(), pacer_.pace());
    pacer_.restart(now());
}

void Stepper::start_anew() {
    put_back(std::move(recording_));
    ride_->reset();
    end_.reset();
    pacer_.restart(now());
}

void Stepper::put_back(std::shared_ptr<void> thing) {
    if (thing) put_back_.push_back(std::move(thing));
}

void Stepper::step() {
    if (std::exchange(resting_, false)) pacer_.restart(now());
    sleep_until(pacer_.deadline());
    pacer_.begin(now());
    held_.fetch();
    end_ = ride_->advance(held_.value());
    const long steps = ride_->steps_taken();
    if (end_ || steps % ride_->steps_in(frame_interval * pacer_.pace()) == 0) {
        ride_->show(held_.value());
        bell_.ring();
    }
    if (recording_ && !end_ && steps % ride_->steps_in(Recording::interval) == 0) {
        const auto position = ride_->state().position();
        recording_->put(ride_->time(), position[0], position[1], ride_->observe());
    }
    const Nanoseconds done = now();
    pacer_.end(done);
    if (end_ || done >= next_report_) report();
}

void Stepper::rest() {
    resting_ = true;
    const Nanoseconds time = now();
    if (time >= next_report_) report();
    sleep_until(time + rest_interval);
}

void Stepper::report() {
    next_report_ = now() + report_interval;
    Progress& progress = progress_.draft();
    progress.car = ride_->number();
    progress.paused = paused();
    progress.ended = end_ ? end_->message : std::string();
    progress.pace = pacer_.pace();
    progress.time = ride_->time();
    progress.step = ride_->step();
    progress.report = pacer_.report();
    progress_.publish();
}

}  // namespace hamilcar::live
