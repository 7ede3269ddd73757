#include "hamilcar/run/run_loop.hpp"

#include <chrono>

namespace hamilcar {

namespace {

// However rare the samples and however slow the steps, Ctrl-C is noticed in time: the number of steps between two questions is
// chosen so that they take a tenth of a second, or so many that asking costs nothing beside them.
class QuestionTimer {
public:
    bool is_due() {
        if (++steps_ < steps_between_) return false;
        const auto now = std::chrono::steady_clock::now();
        const double took = std::chrono::duration<double>(now - last_).count();
        const double wanted = static_cast<double>(steps_between_) * wanted_time / std::max(took, 1e-6);
        steps_between_ = std::lround(std::clamp(wanted, 1.0, max_steps));
        steps_ = 0, last_ = now;
        return true;
    }

private:
    static constexpr double wanted_time = 0.1, max_steps = 1000;  // [s]
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    long steps_ = 0, steps_between_ = 1;
};

}  // namespace

RunEnd run_to_end(Simulation& simulation, const RunWatch& watch) {
    using Cause = RunEnd::Cause;
    const long every = steps_per_row(simulation, watch.interval);
    const auto is_due = [&] { return simulation.steps_taken() % every == 0; };
    const auto ended = [&](bool sampled, Cause cause, std::string message = "") {
        if (!sampled && watch.last_state) watch.on_sample(simulation.sample());
        return RunEnd{cause, std::move(message)};
    };
    QuestionTimer timer;
    bool sampled = is_due();
    if (sampled && !watch.on_sample(simulation.sample())) return ended(true, Cause::watch);
    while (!simulation.finished()) {
        if (auto end = simulation.advance()) return ended(sampled, Cause::failure, std::move(end->message));
        if (simulation.ending()) return ended(sampled, Cause::driver);  // at the state before
        sampled = is_due();
        if (sampled && !watch.on_sample(simulation.sample())) return ended(true, Cause::watch);
        if ((timer.is_due() || sampled) && !watch.keep_going()) return ended(sampled, Cause::interrupted);
    }
    return ended(sampled, simulation.ending() ? Cause::driver : Cause::duration);
}

}  // namespace hamilcar
