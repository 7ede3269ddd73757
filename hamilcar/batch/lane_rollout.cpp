#include "hamilcar/batch/lane_rollout.hpp"

#include <cmath>
#include <limits>

namespace hamilcar {

namespace {

constexpr std::size_t most_bytes_kept = std::size_t{64} << 20;  // by a thread
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const Method& method_of(const Simulation& car) {
    return *find_method(car.scenario().solver.integrator);
}

}  // namespace

LaneRollout::LaneRollout(RolloutPrograms& programs, const LaneRuns& runs, const RolloutNumbers* along)
    : programs_(&programs),
      runs_(runs),
      along_(along),
      lanes_(static_cast<std::size_t>(programs.lanes())),
      step_(runs.cars[0].simulation->scenario().solver.step),
      rhs_(programs, along ? programs.with_tangents() : programs.plain(), along != nullptr),
      controls_(cars(), runs.steps, step_),
      integrator_(method_of(*runs.cars[0].simulation), step_, static_cast<int>(rhs_.state_count()), 0,
                  Numbers(rhs_.state_count())),
      inputs_((along ? std::size_t{2} : std::size_t{1}) * RhsInput::size * lanes_),
      now_(rhs_.state_count()),
      first_(rhs_.report()),
      further_(rhs_.report()),
      failed_(lanes_) {
    const std::size_t count = programs.parameters().size();
    const Simulation* known = nullptr;  // many runs are of one car
    std::vector<double> numbers;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
        const Simulation* car = runs_.cars[run_of(lane)].simulation;
        if (car != known) numbers = programs.parameters_of(car->model());
        known = car;
        for (std::size_t i = 0; i < count; ++i) {
            rhs_.parameter(i, lane) = numbers[i];
            if (along) rhs_.parameter(count + i, lane) = along->parameters[run_of(lane) * count + i];
        }
        rhs_.set_surface(lane, car->model().surface);
    }
    start();
}

std::vector<RolloutCar> LaneRollout::cars() const {
    std::vector<RolloutCar> out;
    for (std::size_t lane = 0; lane < lanes_; ++lane) out.push_back(runs_.cars[run_of(lane)]);
    return out;
}

void LaneRollout::set_lanes(const std::vector<double>& from, std::size_t count, double* to) const {
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
        for (std::size_t i = 0; i < count; ++i) to[i * lanes_ + lane] = from[run_of(lane) * count + i];
    }
}

void LaneRollout::start() {
    const std::size_t count = programs_->state_size();
    set_lanes(runs_.numbers->states, count, now_.data());
    if (along_) set_lanes(along_->states, count, now_.data() + count * lanes_);
}

std::vector<LaneControls::Row> LaneRollout::targets(const RolloutNumbers& of, std::size_t row) const {
    std::vector<LaneControls::Row> out;
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
        const std::size_t run = run_of(lane);
        out.push_back(
            {of.controls.data() + place_of_controls(run, row), of.controls.data() + place_of_controls(run, row + 1)});
    }
    return out;
}

RolloutRhs::Input LaneRollout::input_at(long step, double ahead) {
    const Numbers& plain = controls_.inputs(step, ahead);
    std::ranges::copy(plain.values, inputs_.values.begin());
    return {inputs_, controls_.times().at.data(), ahead};
}

void LaneRollout::do_row(std::size_t row, std::vector<StepRecord>* records) {
    controls_.begin_row(row, targets(*runs_.numbers, row));
    std::vector<LaneControls::Row> along;
    if (along_) along = targets(*along_, row);
    if (records) records->clear();
    for (long k = 0; k < runs_.steps && !stops(); ++k) {
        rhs_.record(records ? &records->emplace_back() : nullptr);
        const auto inputs = [&](double ahead) {
            const RolloutRhs::Input at = input_at(k, ahead);
            if (along_) controls_.tangents(along, inputs_.data() + RhsInput::size * lanes_);
            return at;
        };
        integrate(rhs_, integrator_, inputs, 0, now_, now_, first_, further_);
        check(now_);
    }
    rhs_.record(nullptr);
    controls_.hold_end();
}

void LaneRollout::check(const Numbers& state) {
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
        const Health<double> health{first_.numbers.values[RhsReport::violation * lanes_ + lane],
                                    first_.numbers.values[RhsReport::mobility * lanes_ + lane]};
        double sum = 0;  // of a NaN or an infinity no finite number is left
        for (std::size_t i = 0; i < programs_->state_size(); ++i) sum += state.values[i * lanes_ + lane];
        if (health.locks() || health.loops_open() || !std::isfinite(sum)) failed_[lane] = true;
    }
}

void LaneRollout::read(std::size_t row, RolloutResults& out, RolloutResults* changes) {
    const std::size_t count = programs_->channel_count();
    if (count == 0) return;
    Numbers values((along_ ? 2 : 1) * count * lanes_);
    const RolloutRhs::Input input = input_at(runs_.steps, 0);
    if (along_) controls_.tangents(targets(*along_, row), inputs_.data() + RhsInput::size * lanes_);
    const RolloutPrograms::Pair& pair = along_ ? programs_->with_tangents() : programs_->plain();
    rhs_.run(*pair.sample, input, now_, [&](program::Frame& frame) { frame.arrays[rhs_rate] = values.data(); });
    for (std::size_t lane = 0; lane < lanes_ && is_used(lane); ++lane) {
        const std::size_t place = (run_of(lane) * runs_.rows + row) * count;
        for (std::size_t i = 0; i < count; ++i) {
            out.channels[place + i] = failed_[lane] ? not_a_number : values.values[i * lanes_ + lane];
            if (!changes) continue;
            changes->channels[place + i] = failed_[lane] ? not_a_number : values.values[(count + i) * lanes_ + lane];
        }
    }
}

void LaneRollout::write_ends(RolloutResults& out, RolloutResults* changes) const {
    const std::size_t count = programs_->state_size();
    for (std::size_t lane = 0; lane < lanes_ && is_used(lane); ++lane) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t place = run_of(lane) * count + i;
            out.states[place] = failed_[lane] ? not_a_number : now_.values[i * lanes_ + lane];
            if (!changes) continue;
            changes->states[place] = failed_[lane] ? not_a_number : now_.values[(count + i) * lanes_ + lane];
        }
    }
}

void LaneRollout::run(RolloutResults& out, RolloutResults* changes) {
    for (std::size_t row = 0; row < runs_.rows; ++row) {
        do_row(row, nullptr);
        read(row, out, changes);
    }
    write_ends(out, changes);
}

// The correction is a Newton step on Phi(V, W, t) = 0: where that holds its derivative by W is -1, and by all else that of W.
void LaneRollout::close(std::vector<double>& states) {
    controls_.begin_row(0, targets(*runs_.numbers, 0));
    const RolloutRhs::Input input = input_at(0, 0);
    controls_.tangents(targets(*along_, 0), inputs_.data() + RhsInput::size * lanes_);
    Numbers rate(rhs_.state_count());
    rhs_.evaluate(input, now_, rate, first_);
    const double* correction =
        first_.numbers.data() + (programs_->report_size() + std::size_t{RhsReport::correction}) * lanes_;
    for (const int index : programs_->correction_indices()) {
        for (std::size_t lane = 0; lane < lanes_; ++lane, ++correction) {
            if (is_used(lane))
                states[run_of(lane) * programs_->state_size() + static_cast<std::size_t>(index)] += *correction;
        }
    }
}

LaneRollout::Adjoints LaneRollout::new_adjoints() const {
    const std::size_t states = programs_->state_size() * lanes_, parameters = programs_->parameters().size() * lanes_;
    const auto stages = static_cast<std::size_t>(classical_runge_kutta.stages);
    return {.state = Numbers(states),
            .parameters = Numbers(parameters),
            .report = Numbers(programs_->report_size() * lanes_),
            .read_state = Numbers(states),
            .read_input = Numbers(RhsInput::size * lanes_),
            .read_parameters = Numbers(parameters),
            .rates = std::vector<Numbers>(stages, Numbers(states)),
            .controls = {}};
}

void LaneRollout::gradient(const RolloutResults& weights, RolloutNumbers& out) {
    // Of short runs everything is kept; of longer ones the states at the rows, and each row is computed once more.
    const std::size_t bytes_of_step = classical_runge_kutta.stages * now_.values.size() * sizeof(double);
    const bool keeps_all = runs_.rows * static_cast<std::size_t>(runs_.steps) * bytes_of_step <= most_bytes_kept;
    std::vector<Numbers> after_rows;
    std::vector<std::vector<StepRecord>> records(keeps_all ? runs_.rows : 1);
    const Numbers start = now_;
    for (std::size_t row = 0; row < runs_.rows; ++row) {
        do_row(row, keeps_all ? &records[row] : nullptr);
        after_rows.push_back(now_);
    }
    Adjoints adjoints = new_adjoints();
    set_lanes(weights.states, programs_->state_size(), adjoints.state.data());
    std::vector<double> unused(2 * control_count(0));  // for lanes without a run
    for (std::size_t row = runs_.rows; row-- > 0;) {
        if (!keeps_all) {
            now_ = row == 0 ? start : after_rows[row - 1];
            do_row(row, &records[0]);
        }
        now_ = after_rows[row];
        controls_.begin_row(row, targets(*runs_.numbers, row));
        controls_.hold_end();
        adjoints.controls.clear();
        for (std::size_t lane = 0; lane < lanes_; ++lane) {
            double* from = is_used(lane) ? out.controls.data() + place_of_controls(run_of(lane), row) : unused.data();
            adjoints.controls.push_back({from, from + control_count(run_of(lane))});
        }
        add_channels(row, weights, adjoints);
        controls_.begin_row(row, targets(*runs_.numbers, row));
        const std::vector<StepRecord>& own = records[keeps_all ? row : 0];
        for (std::size_t k = own.size(); k-- > 0 && !stops();) step_back(static_cast<long>(k), own[k], adjoints);
    }
    const auto write = [&](const Numbers& from, std::size_t count, std::vector<double>& to) {
        for (std::size_t lane = 0; lane < lanes_ && is_used(lane); ++lane) {
            for (std::size_t i = 0; i < count; ++i) {
                to[run_of(lane) * count + i] = failed_[lane] ? not_a_number : from.values[i * lanes_ + lane];
            }
        }
    };
    for (std::size_t lane = 0; lane < lanes_ && is_used(lane); ++lane) {
        if (!failed_[lane]) continue;
        std::fill_n(out.controls.begin() + static_cast<long>(place_of_controls(run_of(lane), 0)),
                    (runs_.rows + 1) * control_count(run_of(lane)), not_a_number);
    }
    write(adjoints.state, programs_->state_size(), out.states);
    write(adjoints.parameters, programs_->parameters().size(), out.parameters);
}

// With the state after the row, where channels are read.
void LaneRollout::add_channels(std::size_t row, const RolloutResults& weights, Adjoints& adjoints) {
    const std::size_t count = programs_->channel_count();
    if (count == 0) return;
    Numbers of_results(count * lanes_);
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
        const std::size_t place = (run_of(lane) * runs_.rows + row) * count;
        for (std::size_t i = 0; i < count; ++i) of_results.values[i * lanes_ + lane] = weights.channels[place + i];
    }
    run_back(*programs_->adjoint().sample, input_at(runs_.steps, 0), now_, of_results, adjoints);
    add_scaled(1.0, adjoints.read_state.data(), adjoints.state.data(), static_cast<int>(adjoints.state.values.size()));
}

// Runs an adjoint program; the state's adjoint is left in `read_state`, the others are added up.
void LaneRollout::run_back(const program::Executable& program, const RolloutRhs::Input& input, const Numbers& state,
                           Numbers& results, Adjoints& adjoints) {
    std::ranges::fill(adjoints.read_state.values, 0.0);
    std::ranges::fill(adjoints.read_input.values, 0.0);
    std::ranges::fill(adjoints.read_parameters.values, 0.0);
    rhs_.run(program, input, state, [&](program::Frame& frame) {
        frame.arrays[rhs_rate] = results.data();
        frame.arrays[rhs_report] = adjoints.report.data();
        frame.arrays[rollout_state_adjoint] = adjoints.read_state.data();
        frame.arrays[rollout_input_adjoint] = adjoints.read_input.data();
        frame.arrays[rollout_parameter_adjoint] = adjoints.read_parameters.data();
    });
    controls_.add_adjoints(adjoints.read_input.data(), adjoints.controls);
    add_scaled(1.0, adjoints.read_parameters.data(), adjoints.parameters.data(),
               static_cast<int>(adjoints.parameters.values.size()));
}

// From the adjoint of the state after a step to that of the state before it: y = x + h sum_s b_s f(x + h sum_j a_sj f_j), with
// the corrections that the first evaluation found and the quaternion normalized.
void LaneRollout::step_back(long step, const StepRecord& record, Adjoints& adjoints) {
    const Tableau& method = classical_runge_kutta;
    const auto size = static_cast<int>(adjoints.state.values.size());
    if (!record.orientation.values.empty()) rhs_.adjoint_of_normalizing(record.orientation, adjoints.state);
    std::vector<double> corrected;  // adjoints of what the corrections were added to
    for (const int index : programs_->correction_indices()) {
        const double* from = adjoints.state.data() + static_cast<std::size_t>(index) * lanes_;
        corrected.insert(corrected.end(), from, from + lanes_);
    }
    for (int s = 0; s < method.stages; ++s) {
        Numbers& rate = adjoints.rates[static_cast<std::size_t>(s)];
        std::ranges::fill(rate.values, 0.0);
        add_scaled(step_ * method.weights[static_cast<std::size_t>(s)], adjoints.state.data(), rate.data(), size);
    }
    for (std::size_t s = static_cast<std::size_t>(method.stages); s-- > 0;) {
        if (s == 0) std::ranges::copy(corrected, adjoints.report.data() + RhsReport::correction * lanes_);
        const StepRecord::Stage& stage = record.stages[s];
        run_back(*programs_->adjoint().rhs, input_at(step, stage.ahead), stage.state, adjoints.rates[s], adjoints);
        for (std::size_t j = 0; j < s; ++j) {
            add_scaled(step_ * method.stage[s][j], adjoints.read_state.data(), adjoints.rates[j].data(), size);
        }
        add_scaled(1.0, adjoints.read_state.data(), adjoints.state.data(), size);
    }
    std::ranges::fill(adjoints.report.values, 0.0);
}

}  // namespace hamilcar
