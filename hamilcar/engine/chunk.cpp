#include "hamilcar/engine/chunk.hpp"

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/flush.hpp"
#include "hamilcar/engine/lane_driver.hpp"
#include "hamilcar/engine/lane_ring.hpp"

namespace hamilcar {

namespace {

// A lane whose car has ended is parked on a copy of a car that still runs: it costs nothing more and can neither stop its
// neighbors nor slow them down; what it computes from then on is never looked at.
template <class E>
class LaneChunk final : public Chunk {
public:
    LaneChunk(std::shared_ptr<const TurnProgram> program, std::span<const LaneCar> cars, const ChunkSettings& settings)
        : settings_(settings),
          program_(std::move(program)),
          lanes_(program_->executable->lanes()),
          ring_(*program_),
          first_(ring_.report()),
          further_(ring_.report()),
          size_(static_cast<std::size_t>(program_->state_size * lanes_)),
          now_(size_),
          next_(size_),
          integrator_(settings.method, settings.step, static_cast<int>(size_), 0, Numbers(size_)),
          driver_(lanes_),
          lane_states_(cars.size()) {
        for (int i = 0; i < lanes_; ++i) {
            const LaneCar& car = cars[static_cast<std::size_t>(i) < cars.size() ? static_cast<std::size_t>(i) : 0];
            ring_.set_car(i, *car.model);
            driver_.set_schedule(i, *car.schedule);
            for (std::size_t k = 0; k < static_cast<std::size_t>(program_->state_size); ++k) {
                at(now_, k, i) = static_cast<E>(car.state->values[k]);
            }
        }
    }

    void advance(long steps) override {
        const FlushTinyNumbers flush;
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
        State<double> last;  // good, of a car that has ended
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
        const auto input_at = [this](double t) { return typename LaneRing<E>::Input{driver_(t), t}; };
        integrate(ring_, integrator_, input_at, time(), now_, next_, first_, further_);
        std::swap(now_, next_);  // `next_` is the one before from here on
        if (!all_good()) [[unlikely]]
            end_cars();
    }

    bool all_good() const {
        bool good = all_finite(now_.data(), static_cast<int>(size_));
        for (int i = 0; i < lanes_; ++i) good &= own_reason_to_end(i) == EndReason::none;
        return good;
    }

    EndReason reason_to_end(int lane) const {
        for (std::size_t k = 0; k < static_cast<std::size_t>(program_->state_size); ++k) {
            if (!std::isfinite(at(now_, k, lane))) return EndReason::not_finite;
        }
        return own_reason_to_end(lane);
    }

    // Of a car with finite numbers.
    EndReason own_reason_to_end(int lane) const {
        const auto i = static_cast<std::size_t>(lane);
        const Health<E> health = first_.health(i);
        if (health.locks()) return EndReason::locked;
        if (health.comes_apart()) return EndReason::came_apart;
        if (settings_.tilt_cosine > -1 && !(height_of_z_axis(i) >= static_cast<E>(settings_.tilt_cosine))) {
            return EndReason::rolled_over;
        }
        return EndReason::none;
    }

    // Of the chassis z axis's direction on the ground's, 1 upright.
    E height_of_z_axis(std::size_t lane) const {
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

    // Also the lanes that never had a car of their own.
    void park() {
        const int from = survivor();
        if (from < 0) return;
        for (int i = 0; i < lanes_; ++i) {
            const auto own = static_cast<std::size_t>(i);
            const bool vacant = own >= lane_states_.size();
            if (!vacant && (lane_states_[own].running() || lane_states_[own].parked)) continue;
            ring_.copy_car(from, i);
            driver_.copy_schedule(from, i);
            copy_lane(now_, lanes_, from, i);
            integrator_.change_past([&](Numbers& past) { copy_lane(past, lanes_, from, i); });
            if (!vacant) lane_states_[own].parked = true;
        }
    }

    ChunkSettings settings_;
    std::shared_ptr<const TurnProgram> program_;
    int lanes_;
    LaneRing<E> ring_;
    typename LaneRing<E>::Report first_, further_;
    std::size_t size_;
    Numbers now_, next_;  // states: the present one, and the one before or after
    Integrator<Numbers> integrator_;
    LaneDriver<E> driver_;
    std::vector<LaneState> lane_states_;  // of the cars
    long step_count_ = 0;
};

}  // namespace

std::unique_ptr<Chunk> make_chunk(std::shared_ptr<const TurnProgram> program, std::span<const LaneCar> cars,
                                  const ChunkSettings& settings) {
    if (program->executable->precision() == Precision::single_precision) {
        return std::make_unique<LaneChunk<float>>(std::move(program), cars, settings);
    }
    return std::make_unique<LaneChunk<double>>(std::move(program), cars, settings);
}

}  // namespace hamilcar
