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
constexpr Nanoseconds report_interval = 100 * millisecond, idle_interval = 5 * millisecond;
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

// Real-time priority if allowed, otherwise a lower nice value if allowed. A single processor is not monopolized.
void raise_priority() {
    const sched_param lowest_of_real_time{.sched_priority = sched_get_priority_min(SCHED_FIFO)};
    constexpr int nice_value = -10;
    if (std::thread::hardware_concurrency() > 1 &&
        pthread_setschedparam(pthread_self(), SCHED_FIFO, &lowest_of_real_time) == 0) {
        return;
    }
    setpriority(PRIO_PROCESS, 0, nice_value);  // of this thread alone, on Linux
}

}  // namespace

Stepper::Stepper(std::shared_ptr<LiveSimulation> simulation, const WakeUp& wake_up)
    : wake_up_(wake_up),
      simulation_(std::move(simulation)),
      pacer_(simulation_->step()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Stepper::set_controls(const ReceivedControls& received) {
    received_.draft() = received;
    received_.publish();
}

std::vector<std::shared_ptr<void>> Stepper::take_released() {
    const std::lock_guard lock(mutex_);
    return std::exchange(released_, {});
}

const Progress& Stepper::progress() {
    progress_.fetch();
    return progress_.value();
}

Pause Stepper::paused() const {
    if (end_) return Pause::ended;
    if (!driven_) return Pause::no_driver;
    return paused_by_driver_ ? Pause::driver : Pause::none;
}

void Stepper::run(const std::stop_token& stop) {
    raise_priority();
    report();
    while (!stop.stop_requested()) {
        apply_commands();
        if (paused() == Pause::none) {
            step();
        } else {
            wait_idle();
        }
    }
}

void Stepper::apply_commands() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock() || !std::exchange(has_commands_, false)) return;
    Commands commands = std::exchange(commands_, {});
    if (commands.simulation) replace_simulation(std::move(commands.simulation));
    if (commands.reset) restart();
    if (commands.recording && &commands.recording->simulation() != simulation_.get())
        release(std::move(commands.recording));
    if (commands.recording) recording_ = std::move(commands.recording);
    if (commands.stop_recording)
        release(std::move(recording_));  // also one that was posted together with this: it was opened earlier
    if (commands.pause) paused_by_driver_ = *commands.pause;
    if (commands.driven) driven_ = *commands.driven;
    if (commands.aids_off) simulation_->switch_off(*commands.aids_off);
    if (commands.pace) pacer_.set_pace(*commands.pace, now());
    report();
    wake_up_.signal();
}

void Stepper::replace_simulation(std::shared_ptr<LiveSimulation> simulation) {
    release(std::move(recording_));
    release(std::exchange(simulation_, std::move(simulation)));
    end_.reset();
    pacer_ = Pacer(simulation_->step(), pacer_.pace());
    pacer_.restart(now());
}

void Stepper::restart() {
    release(std::move(recording_));
    simulation_->reset();
    end_.reset();
    pacer_.restart(now());
}

void Stepper::release(std::shared_ptr<void> object) {
    if (object) released_.push_back(std::move(object));
}

void Stepper::step() {
    if (std::exchange(idle_, false)) pacer_.restart(now());
    sleep_until(pacer_.wake_time(now()));
    pacer_.begin(now());
    received_.fetch();
    end_ = simulation_->advance(received_.value());
    const long steps = simulation_->steps_taken();
    if (end_ || steps % simulation_->steps_in(frame_interval * pacer_.pace()) == 0) {
        simulation_->publish_frame(received_.value());
        wake_up_.signal();
    }
    if (recording_ && !end_ && steps % simulation_->steps_in(Recording::interval) == 0) {
        const auto position = simulation_->state().position();
        recording_->add_row(simulation_->time(), position[0], position[1], simulation_->channel_values());
    }
    const Nanoseconds done = now();
    pacer_.end(done);
    if (end_ || done >= next_report_) report();
}

void Stepper::wait_idle() {
    idle_ = true;
    const Nanoseconds time = now();
    if (time >= next_report_) report();
    sleep_until(time + idle_interval);
}

void Stepper::report() {
    next_report_ = now() + report_interval;
    Progress& progress = progress_.draft();
    progress.car = simulation_->number();
    progress.paused = paused();
    progress.ended = end_ ? end_->message : std::string();
    progress.pace = pacer_.pace();
    progress.time = simulation_->time();
    progress.step = simulation_->step();
    progress.report = pacer_.report();
    progress_.publish();
}

}  // namespace hamilcar::live
