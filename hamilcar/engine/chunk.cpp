#include "hamilcar/engine/chunk.hpp"

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "hamilcar/engine/lane_driver.hpp"
#include "hamilcar/engine/lane_rhs.hpp"

namespace hamilcar {

namespace {

// A lane whose car has ended continues with a copy of a car that still runs: so it can neither stop its neighbors nor slow
// them down (by NaNs or denormals). Its results are ignored.
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
          driver_(lanes_),
          lane_states_(cars.size()) {
        for (int i = 0; i < lanes_; ++i) {
            const LaneCar& car = cars[static_cast<std::size_t>(i) < cars.size() ? static_cast<std::size_t>(i) : 0];
            rhs_.set_car(i, *car.model);
            driver_.set_schedule(i, *car.schedule);
            for (std::size_t k = 0; k < static_cast<std::size_t>(program_->state_size); ++k) {
                at(now_, k, i) = static_cast<E>(car.state->values[k]);
            }
        }
    }

    void advance(long steps) override {
        const FlushDenormals flush;
        for (long i = 0; i < steps; ++i) {
            if (survivor() >= 0) advance_once();
            ++step_count_;
        }
    }
    double time() const override { return static_cast<double>(step_count_) * settings_.step; }
    CarEnd end(int lane) const override { return lane_states_[static_cast<std::size_t>(lane)].end; }
    State<double> state(int lane) const override {
        const LaneState& own = lane_states_[static_cast<std::size_t>(lane)];
        return own.running() ? state_of(now_, lane) : own.last;
    }
    void set_schedule(int lane, const Schedule& schedule) override {
        if (lane_states_[static_cast<std::size_t>(lane)].running()) driver_.set_schedule(lane, schedule);
    }

private:
    using Numbers = LaneNumbers<E>;
    struct LaneState {
        CarEnd end;
        State<double> last;  // the last good state, of a car that has ended
        bool parked = false;
        bool running() const { return end.reason == EndReason::none; }
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

    void advance_once() {
        const auto input_at = [this](double t) { return typename LaneRhs<E>::Input{driver_(t), t}; };
        integrate(rhs_, integrator_, input_at, time(), now_, next_, first_, further_);
        std::swap(now_, next_);  // from here on `next_` is the previous state
        if (!all_good()) [[unlikely]]
            end_cars();
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
            if (own.running()) own.end = {reason, time()}, own.last = state_of(next_, static_cast<int>(i));
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
    Numbers now_, next_;  // states: the present one, and the previous or next one
    Integrator<Numbers> integrator_;
    LaneDriver<E> driver_;
    std::vector<LaneState> lane_states_;  // of the cars
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
