#include "hamilcar/engine/chunk.hpp"

#include <algorithm>
#include <optional>

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "hamilcar/engine/lane_driver.hpp"
#include "hamilcar/engine/lane_rhs.hpp"

namespace hamilcar {

namespace {

// A lane whose car has ended continues with a copy of a car that still runs: so it can neither stop its neighbors nor slow
// them down (by NaNs or denormals). Its results are ignored.
//
// Cars begin when they like: each has its own time. A multi-step method needs a past that a new car does not have; while there
// is one, all lanes do the method's step and that of its start, and each takes its own.
template <class E>
class LaneChunk final : public Chunk {
public:
    LaneChunk(std::shared_ptr<const RhsProgram> program, std::span<const LaneCar> cars, const ChunkSettings& settings)
        : settings_(settings),
          program_(std::move(program)),
          lanes_(program_->executable->lanes()),
          rhs_(*program_),
          first_(rhs_.report()),
          further_(rhs_.report()),
          size_(static_cast<std::size_t>(program_->state_size * lanes_)),
          now_(size_),
          next_(size_),
          integrator_(settings.method, settings.step, static_cast<int>(size_), 0, Numbers(size_)),
          driver_(lanes_, program_->commands),
          clocks_(static_cast<std::size_t>(lanes_)),
          times_{std::vector<double>(static_cast<std::size_t>(lanes_))},
          lane_states_(cars.size()) {
        for (int i = 0; i < lanes_; ++i) {
            put(i, cars[static_cast<std::size_t>(i) < cars.size() ? static_cast<std::size_t>(i) : 0]);
        }
    }

    void advance(long steps) override {
        const FlushDenormals flush;
        for (long i = 0; i < steps; ++i) {
            if (survivor() >= 0) advance_once();
            ++step_count_;
        }
    }
    double time(int lane) const override { return static_cast<double>(steps(lane)) * settings_.step; }
    long steps(int lane) const override { return step_count_ - clocks_[static_cast<std::size_t>(lane)].start; }
    CarEnd end(int lane) const override { return lane_states_[static_cast<std::size_t>(lane)].end; }
    State<double> state(int lane) const override {
        const LaneState& own = lane_states_[static_cast<std::size_t>(lane)];
        return own.running() ? state_of(now_, lane) : own.last;
    }
    void set_schedule(int lane, const Schedule& schedule) override {
        if (lane_states_[static_cast<std::size_t>(lane)].running()) driver_.set_schedule(lane, schedule);
    }

    void set_car(int lane, const LaneCar& car, const LanePast* past) override {
        lane_states_[static_cast<std::size_t>(lane)] = {};
        put(lane, car);
        for (LaneState& state : lane_states_) state.parked = false;  // on a copy of what stood here, perhaps
        park();
        if (!past) return;
        const int order = settings_.method.order;
        clocks_[static_cast<std::size_t>(lane)] = {step_count_ - past->steps, past->rates.remembered};
        compare_clocks();
        for (int back = 0; back < past->rates.remembered; ++back) {
            const auto at = static_cast<std::size_t>((past->rates.newest + order - back) % order);
            set_lane(integrator_.past(back), lane, past->rates.past[at]);
        }
    }
    void measurement(int lane, double* to) const override {
        const E* from = first_.numbers.data() + static_cast<std::size_t>(program_->measurement() * lanes_ + lane);
        for (int i = 0; i < program_->measured; ++i)
            to[i] = static_cast<double>(from[static_cast<std::ptrdiff_t>(i) * lanes_]);
    }
    void save_past(int lane, LanePast& to) const override {
        const int order = settings_.method.order;
        to.steps = steps(lane);
        to.rates.remembered = clocks_[static_cast<std::size_t>(lane)].remembered;
        to.rates.newest = remembers() ? static_cast<int>(to.steps % order) : 0;  // as in an Integrator of its own
        to.rates.substep = settings_.step, to.rates.converged = true;
        for (int back = 0; back < to.rates.remembered; ++back) {
            const auto at = static_cast<std::size_t>((to.rates.newest + order - back) % order);
            to.rates.past[at] = state_of(integrator_.past(back), lane);
        }
    }

    std::vector<double> sample(const program::Executable& program, std::size_t count) override {
        const FlushDenormals flush;
        sample_ = Numbers(count * static_cast<std::size_t>(lanes_));
        set_times();
        rhs_.run(program, inputs_at(0), now_, sample_.data());
        return {sample_.values.begin(), sample_.values.end()};
    }

private:
    using Numbers = LaneNumbers<E>;
    struct LaneState {
        CarEnd end;
        State<double> last;  // the last good state, of a car that has ended
        bool parked = false;
        bool running() const { return end.reason == EndReason::none; }
    };
    struct Clock {
        long start = 0;      // the step at which the lane's car began
        int remembered = 0;  // rates of its past that a multi-step method knows
    };

    template <class Any>
    auto& at(Any& numbers, std::size_t k, int lane) const {
        return numbers.values[k * static_cast<std::size_t>(lanes_) + static_cast<std::size_t>(lane)];
    }
    State<double> state_of(const Numbers& numbers, int lane) const {
        State<double> one;
        for (std::size_t k = 0; k < static_cast<std::size_t>(program_->state_size); ++k) {
            one.values[k] = at(numbers, k, lane);
        }
        return one;
    }
    void set_lane(Numbers& numbers, int lane, const State<double>& from) const {
        for (std::size_t k = 0; k < static_cast<std::size_t>(program_->state_size); ++k) {
            at(numbers, k, lane) = static_cast<E>(from.values[k]);
        }
    }
    void put(int lane, const LaneCar& car) {
        rhs_.set_car(lane, *car.model);
        driver_.set_schedule(lane, *car.schedule);
        set_lane(now_, lane, *car.state);
        clocks_[static_cast<std::size_t>(lane)] = {step_count_, 0};
        compare_clocks();
    }
    void compare_clocks() {
        times_.same = std::ranges::all_of(clocks_, [&](const Clock& one) { return one.start == clocks_[0].start; });
        steps_to_watch_ = remembers() ? settings_.method.order : 0;
    }

    void set_times() {
        if (times_.same) {
            std::ranges::fill(times_.at, time(0));
        } else {
            for (int i = 0; i < lanes_; ++i) times_.at[static_cast<std::size_t>(i)] = time(i);
        }
    }
    // So far ahead of `times_` [s].
    typename LaneRhs<E>::Input inputs_at(double ahead) { return {driver_(times_, ahead), times_.at.data(), ahead}; }

    bool remembers() const {
        return settings_.method.family == MethodFamily::adams_bashforth ||
               settings_.method.family == MethodFamily::adams_bashforth_moulton;
    }
    // A step of the method makes one more rate of the past known before it uses them.
    bool is_starting(const Clock& clock) const { return remembers() && clock.remembered + 1 < settings_.method.order; }

    void advance_once() {
        set_times();
        const auto input_at = [this](double ahead) { return inputs_at(ahead); };
        if (steps_to_watch_ > 0) integrator_.assume_past();
        integrate(rhs_, integrator_, input_at, 0, now_, next_, first_, further_);
        if (steps_to_watch_ > 0) [[unlikely]] {
            if (std::ranges::any_of(clocks_, [&](const Clock& clock) { return is_starting(clock); }))
                start_cars(input_at);
            for (Clock& clock : clocks_) clock.remembered = std::min(clock.remembered + 1, settings_.method.order);
            --steps_to_watch_;
        }
        std::swap(now_, next_);  // from here on `next_` is the previous state
        if (!all_good()) [[unlikely]]
            end_cars();
    }

    // The step of those lanes that have no past, by the method's start.
    template <class InputAt>
    void start_cars(const InputAt& input_at) {
        if (!starter_)
            starter_.emplace(Starter{{settings_.method, settings_.step, static_cast<int>(size_), 0, Numbers(size_)},
                                     Numbers(size_),
                                     rhs_.report()});
        starter_->integrator.restart();
        integrate(rhs_, starter_->integrator, input_at, 0, now_, starter_->next, starter_->first, further_);
        for (int i = 0; i < lanes_; ++i) {
            if (!is_starting(clocks_[static_cast<std::size_t>(i)])) continue;
            copy_lane(starter_->next, next_, lanes_, i);
            copy_lane(starter_->first.numbers, first_.numbers, lanes_, i);
        }
    }

    bool all_good() const {
        bool good = all_finite(now_.data(), static_cast<int>(size_));
        for (int i = 0; i < lanes_; ++i) good &= reason_to_end_if_finite(i) == EndReason::none;
        return good;
    }

    EndReason reason_to_end(int lane) const {
        for (std::size_t k = 0; k < static_cast<std::size_t>(program_->state_size); ++k) {
            if (!std::isfinite(at(now_, k, lane))) return EndReason::not_finite;
        }
        return reason_to_end_if_finite(lane);
    }

    // For a car whose numbers are finite.
    EndReason reason_to_end_if_finite(int lane) const {
        const auto i = static_cast<std::size_t>(lane);
        const Health<E> health = first_.health(i);
        if (health.locks()) return EndReason::locked;
        if (health.loops_open()) return EndReason::loops_open;
        if (settings_.tilt_cosine > -1 && !(tilt_cosine(i) >= static_cast<E>(settings_.tilt_cosine))) {
            return EndReason::rolled_over;
        }
        return EndReason::none;
    }

    // Cosine between the z axes of chassis and ground: 1 upright.
    E tilt_cosine(std::size_t lane) const {
        Vector<E, 4> orientation;
        for (std::size_t k = 0; k < 4; ++k) {
            orientation[static_cast<Eigen::Index>(k)] = now_.values[(3 + k) * static_cast<std::size_t>(lanes_) + lane];
        }
        return program_->chart == ChassisChart::quaternion ? QuaternionChart<E>::rotation(orientation)(2, 2)
                                                           : BryantChart<E>::rotation(orientation)(2, 2);
    }

    void end_cars() {
        for (std::size_t i = 0; i < lane_states_.size(); ++i) {
            LaneState& own = lane_states_[i];
            const EndReason reason = reason_to_end(static_cast<int>(i));
            if (reason == EndReason::none) continue;
            if (own.running())
                own.end = {reason, static_cast<double>(step_count_ - clocks_[i].start) * settings_.step},
                own.last = state_of(next_, static_cast<int>(i));
            own.parked = false;
        }
        park();
    }

    int survivor() const {
        for (std::size_t i = 0; i < lane_states_.size(); ++i) {
            if (lane_states_[i].running()) return static_cast<int>(i);
        }
        return -1;
    }

    // Also lanes that never had a car of their own.
    void park() {
        const int from = survivor();
        if (from < 0) return;
        for (int i = 0; i < lanes_; ++i) {
            const auto own = static_cast<std::size_t>(i);
            const bool vacant = own >= lane_states_.size();
            if (!vacant && (lane_states_[own].running() || lane_states_[own].parked)) continue;
            rhs_.copy_car(from, i);
            driver_.copy_schedule(from, i);
            clocks_[own] = clocks_[static_cast<std::size_t>(from)];
            compare_clocks();
            copy_lane(now_, lanes_, from, i);
            integrator_.change_past([&](Numbers& past) { copy_lane(past, lanes_, from, i); });
            if (!vacant) lane_states_[own].parked = true;
        }
    }

    ChunkSettings settings_;
    std::shared_ptr<const RhsProgram> program_;
    int lanes_;
    LaneRhs<E> rhs_;
    typename LaneRhs<E>::Report first_, further_;
    std::size_t size_;
    Numbers sample_;
    Numbers now_, next_;  // states: the present one, and the previous or next one
    Integrator<Numbers> integrator_;
    LaneDriver<E> driver_;
    std::vector<Clock> clocks_;           // of the lanes
    LaneTimes times_;                     // at the present step
    int steps_to_watch_ = 0;              // after these every car has the past that the method uses
    std::vector<LaneState> lane_states_;  // of the cars
    struct Starter {
        Integrator<Numbers> integrator;
        Numbers next;
        typename LaneRhs<E>::Report first;
    };
    std::optional<Starter> starter_;  // of multi-step methods
    long step_count_ = 0;
};

}  // namespace

std::unique_ptr<Chunk> make_chunk(std::shared_ptr<const RhsProgram> program, std::span<const LaneCar> cars,
                                  const ChunkSettings& settings) {
    if (program->executable->precision() == Precision::single_precision) {
        return std::make_unique<LaneChunk<float>>(std::move(program), cars, settings);
    }
    return std::make_unique<LaneChunk<double>>(std::move(program), cars, settings);
}

}  // namespace hamilcar
