// A chunk of cars in lock step, one in each lane of T: the four blocks as they are, with T for a number.
//
// A lane whose car has ended is parked on a copy of a car that still runs: it costs nothing more and can neither stop its
// neighbors nor slow them down; what it computes from then on is never looked at.
#pragma once

#include <array>

#include "hamilcar/block/integration.hpp"
#include "hamilcar/engine/engine.hpp"
#include "hamilcar/engine/flush.hpp"
#include "hamilcar/engine/lane_driver.hpp"

namespace hamilcar {

template <class T>
class LaneChunk final : public Chunk {
public:
    static constexpr int lanes = lane_count<T>;

    LaneChunk(const LaneCar* cars, int count, const ChunkSettings& settings)
        : settings_(settings),
          size_(cars[0].model->vehicle.state_size),
          integrator_(settings.method, settings.step, size_),
          count_(count) {
        for (int i = 0; i < lanes; ++i) {
            const LaneCar& car = cars[i < count ? i : 0];
            models_[static_cast<std::size_t>(i)] = car.model;
            driver_.set_schedule(i, *car.schedule);
            for (std::size_t k = 0; k < states_[0].values.size(); ++k) {
                set_lane(states_[0].values[k], i, static_cast<Element<T>>(car.state->values[k]));
            }
        }
        for (int i = 0; i < count; ++i) running_[static_cast<std::size_t>(i)] = true;
        gather_models();
    }

    void advance(long steps) override {
        const FlushTinyNumbers flush;
        for (long i = 0; i < steps; ++i) {
            if (survivor() >= 0) advance_once();
            ++step_count_;
        }
    }
    double time() const override { return static_cast<double>(step_count_) * settings_.step; }
    CarEnd end(int lane) const override { return ends_[static_cast<std::size_t>(lane)]; }
    State<double> state(int i) const override {
        if (ends_[static_cast<std::size_t>(i)].reason != EndReason::none)
            return last_states_[static_cast<std::size_t>(i)];
        return state_of(states_[now_], i);
    }
    void set_schedule(int lane, const Schedule& schedule) override {
        if (running_[static_cast<std::size_t>(lane)]) driver_.set_schedule(lane, schedule);
    }

private:
    static State<double> state_of(const State<T>& state, int i) {
        State<double> one;
        for (std::size_t k = 0; k < one.values.size(); ++k) one.values[k] = lane(state.values[k], i);
        return one;
    }

    void gather_models() {
        const Model<double>& first = *models_[0];
        model_.chart = first.chart, model_.constraints = first.constraints;
        model_.energy_balance = first.energy_balance;
        gather(model_.vehicle, parts_of([](const Model<double>& m) -> const auto& { return m.vehicle; }));
        gather(model_.road, parts_of([](const Model<double>& m) -> const auto& { return m.road; }));
        model_.surface.any = false;
        for (std::size_t i = 0; i < models_.size(); ++i) {
            model_.surface.lanes[i] = models_[i]->surface.lanes[0];
            model_.surface.any = model_.surface.any || model_.surface.lanes[i];
        }
        gather(model_.stabilization_gain,
               parts_of([](const Model<double>& m) -> const auto& { return m.stabilization_gain; }));
    }
    template <class Part>
    auto parts_of(Part&& part) const {
        return detail::parts(models_, part);
    }

    void advance_once() {
        const auto input_at = [this](double t) { return driver_(t); };
        State<T>& next = states_[1 - now_];
        const Health<T> health = integration_block(model_, integrator_, input_at, time(), states_[now_], next);
        now_ = 1 - now_;
        T finite(0);
        for (int k = 0; k < size_; ++k) finite += T(0) * next.values[static_cast<std::size_t>(k)];
        const T upright = settings_.tilt_cosine > -1 ? height_of_z_axis() : T(1);
        const auto good = finite == T(0) && !health.comes_apart() && !health.locks() &&
                          upright >= T(static_cast<Element<T>>(settings_.tilt_cosine));
        if (any(!good)) [[unlikely]]
            end_cars(health, finite, upright);
    }

    // Of the chassis z axis's direction on the ground's, 1 upright.
    T height_of_z_axis() const {
        const Vector<T, 4> orientation = states_[now_].orientation();
        return with_chart(model_, [&](auto chart) { return T(chart.rotation(orientation)(2, 2)); });
    }

    void end_cars(const Health<T>& health, const T& finite, const T& upright) {
        for (int i = 0; i < lanes; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const Health<Element<T>> own{lane(health.violation, i), lane(health.mobility, i)};
            EndReason reason = EndReason::none;
            if (!(lane(finite, i) == 0)) {
                reason = EndReason::not_finite;
            } else if (own.locks()) {
                reason = EndReason::locked;
            } else if (own.comes_apart()) {
                reason = EndReason::came_apart;
            } else if (lane(upright, i) < static_cast<Element<T>>(settings_.tilt_cosine)) {
                reason = EndReason::rolled_over;
            }
            if (reason == EndReason::none) continue;
            if (running_[at]) ends_[at] = {reason, time()}, last_states_[at] = state_of(states_[1 - now_], i);
            running_[at] = false;
            parked_[at] = false;
        }
        park();
    }

    int survivor() const {
        for (int i = 0; i < count_; ++i) {
            if (running_[static_cast<std::size_t>(i)]) return i;
        }
        return -1;
    }

    void park() {
        const int from = survivor();
        if (from < 0) return;
        for (int i = 0; i < lanes; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (running_[at] || parked_[at]) continue;
            models_[at] = models_[static_cast<std::size_t>(from)];
            driver_.copy_schedule(from, i);
            for (T& number : states_[now_].values) set_lane(number, i, lane(number, from));
            integrator_.copy_lane(from, i);
            parked_[at] = true;
        }
        gather_models();
    }

    ChunkSettings settings_;
    int size_;
    Model<T> model_;
    std::array<State<T>, 2> states_;  // the present one, and the one before
    std::size_t now_ = 0;
    Integrator<State<T>> integrator_;
    LaneDriver<T> driver_;
    int count_;
    long step_count_ = 0;
    std::array<const Model<double>*, static_cast<std::size_t>(lanes)> models_{};
    std::array<bool, static_cast<std::size_t>(lanes)> running_{}, parked_{};
    std::array<CarEnd, static_cast<std::size_t>(lanes)> ends_{};
    std::array<State<double>, static_cast<std::size_t>(lanes)> last_states_{};
};

}  // namespace hamilcar
