#include <algorithm>
#include <map>

#include "hamilcar/program/portable_code.hpp"

namespace hamilcar::program::portable {

namespace {

std::size_t at(Id id) {
    return static_cast<std::size_t>(id);
}

// Places in the scratch memory, taken and given back: the latest again first, while it is still in the cache.
class Places {
public:
    std::size_t take(std::size_t numbers) {
        std::vector<std::size_t>& free = free_[numbers];
        if (free.empty()) {
            size_ += numbers;
            return size_ - numbers;
        }
        const std::size_t place = free.back();
        free.pop_back();
        return place;
    }
    void give_back(std::size_t place, std::size_t numbers) { free_[numbers].push_back(place); }
    std::size_t size() const { return size_; }

private:
    std::map<std::size_t, std::vector<std::size_t>> free_;  // by numbers
    std::size_t size_ = 0;
};

// From a graph to code. Values have places from where they are computed to their last use; parts stand within what they are part
// of, and the results of a call beside one another.
template <class Number>
class Translation {
public:
    Translation(const Graph& graph, int lanes)
        : graph_(graph),
          operands_(at(graph.size())),
          owner_(at(graph.size())),
          last_use_(at(graph.size()), 0),
          order_(order_by_kind(graph)),
          position_(at(graph.size())) {
        code_.lanes = lanes;
        for (Id i = 0; i < graph.size(); ++i) position_[at(order_[at(i)])] = i;
    }

    Code<Number> code() && {
        find_last_uses();
        arguments_ = take(most_arguments());
        auto region = graph_.regions().begin();
        for (Id id = 0; id <= graph_.size(); ++id) {  // which is also the place in the order, at the borders of regions
            while (region != graph_.regions().end() && (in_region_ ? region->last : region->first) == id) {
                in_region_ ? end_region(*region++) : begin_region(*region);
            }
            if (id < graph_.size()) translate(order_[at(id)]);
        }
        for (const Output& output : graph_.outputs()) {
            assert(graph_.node(output.node).width == 1);
            code_.stores.push_back({output.array, at(output.place) * lanes(), operands_[at(output.node)]});
        }
        end_step(Step::Then::go_on);
        code_.scratch_numbers = places_.size();
        return std::move(code_);
    }

private:
    // Moments: the node at place `i` of the order reads its operands at 2 i + 1, a region that begins before it its condition at
    // 2 i, and one that ends there its values likewise.
    Id moment(Id id) const { return 2 * position_[at(id)] + 1; }

    std::size_t lanes() const { return static_cast<std::size_t>(code_.lanes); }
    std::size_t numbers(Id id) const {  // of the place of an owner
        const Node& node = graph_.node(id);
        return lanes() * (node.op == Op::call ? at(graph_.calls()[at(node.a)].result_count) : node.width);
    }
    std::size_t most_arguments() const {
        std::size_t most = 0;
        for (const Call& call : graph_.calls()) most = std::max(most, call.arguments.size());
        return most * lanes();
    }
    std::size_t take(std::size_t numbers) { return numbers == 0 ? 0 : places_.take(numbers); }

    void use(Id id, Id moment) {
        Id& last = last_use_[at(owner_[at(id)])];
        last = std::max(last, moment);
    }

    void find_last_uses() {
        for (Id id = 0; id < graph_.size(); ++id) {
            const Node& node = graph_.node(id);
            owner_[at(id)] = node.op == Op::part || node.op == Op::result ? owner_[at(node.a)] : id;
            const int count = operand_count(node.op);
            if (count > 0) use(node.a, moment(id));
            if (count > 1 && node.op != Op::part) use(node.b, moment(id));
            if (count > 2) use(node.c, moment(id));
            if (node.op == Op::call) {
                for (const Id argument : graph_.calls()[at(node.a)].arguments) use(argument, moment(id));
            }
        }
        for (const Region& region : graph_.regions()) {
            use(region.condition, 2 * region.first);
            for (const Id id : region.defaults) use(id, 2 * region.last);
            for (const Id id : region.results) use(id, 2 * region.last);
        }
        for (const Output& output : graph_.outputs()) use(output.node, 2 * graph_.size() + 1);
    }

    // After the last use of a value its place is free.
    void leave(Id id, Id moment) {
        const Id owner = owner_[at(id)];
        if (last_use_[at(owner)] != moment) return;
        last_use_[at(owner)] = none;
        const Operand operand = operands_[at(owner)];
        if (base_of(operand) == scratch_base && numbers(owner) > 0)
            places_.give_back(offset_of(operand), numbers(owner));
    }

    void emit(Op op, std::size_t numbers, std::size_t result, Operand a, Operand b = 0, Operand c = 0) {
        const Work<Number> how = work<Number>(op, static_cast<int>(numbers));
        const std::size_t here = code_.operations.size();
        if (code_.groups.size() == first_group() || code_.groups.back().work != how)
            code_.groups.push_back({how, here, here});
        ++code_.groups.back().last;
        code_.operations.push_back({static_cast<std::uint32_t>(result), a, b, c});
    }

    // Of the step that is being written.
    std::size_t first_group() const { return code_.steps.empty() ? 0 : code_.steps.back().last; }

    Step& end_step(Step::Then then) {
        code_.steps.push_back({.first = first_group(), .last = code_.groups.size(), .then = then});
        return code_.steps.back();
    }

    void translate(Id id) {
        const Node& node = graph_.node(id);
        Operand& operand = operands_[at(id)];
        switch (node.op) {
            case Op::constant:
            case Op::truth: operand = constant(node); return;
            case Op::input: operand = at_place(arrays_base + at(node.a), at(node.b) * lanes()); return;
            case Op::part:
            case Op::result: operand = operands_[at(node.a)] + static_cast<Operand>(at(node.b) * lanes()); break;
            case Op::merge: return;  // since the region's end
            case Op::call: translate_call(id); break;
            default: translate_operation(id);
        }
        leave_operands(id);
    }

    void leave_operands(Id id) {
        const Node& node = graph_.node(id);
        const int count = operand_count(node.op);
        if (count > 0) leave(node.a, moment(id));
        if (count > 1 && node.op != Op::part) leave(node.b, moment(id));
        if (count > 2) leave(node.c, moment(id));
        if (last_use_[at(id)] == 0) leave(id, 0);  // nobody needs it
    }

    void translate_operation(Id id) {
        const Node& node = graph_.node(id);
        const std::size_t place = take(numbers(id));
        operands_[at(id)] = at_place(scratch_base, place);
        const auto operand = [&](Id from) { return from == none ? 0 : operands_[at(from)]; };
        if (node.op == Op::join) {
            emit(node.op, numbers(id) / 2, place, operand(node.a));
            emit(node.op, numbers(id) / 2, place + numbers(id) / 2, operand(node.b));
        } else {
            emit(node.op, numbers(id), place, operand(node.a), operand(node.b), operand(node.c));
        }
    }

    // In every lane; conditions as bits.
    Operand constant(const Node& node) {
        const std::size_t place = code_.constants.size();
        for (std::size_t i = 0; i < node.width; ++i) {
            const Number value = node.op == Op::truth ? truth_number<Number>(node.a != 0)
                                                      : static_cast<Number>(graph_.constants(node)[i]);
            code_.constants.insert(code_.constants.end(), lanes(), value);
        }
        return at_place(constants_base, place);
    }

    void translate_call(Id id) {
        const Call& call = graph_.calls()[at(graph_.node(id).a)];
        for (std::size_t i = 0; i < call.arguments.size(); ++i) {
            emit(Op::call, lanes(), arguments_ + i * lanes(), operands_[at(call.arguments[i])]);
        }
        Step& step = end_step(Step::Then::call);
        step.function = call.function;
        step.detail = call.detail;
        step.arguments = arguments_;
        step.results = take(numbers(id));
        operands_[at(id)] = at_place(scratch_base, step.results);
        for (const Id argument : call.arguments) leave(argument, moment(id));
    }

    void begin_region(const Region& region) {
        in_region_ = true;
        Step& step = end_step(Step::Then::enter_region);
        step.condition = operands_[at(region.condition)];
        step.numbers = static_cast<int>(numbers(region.condition));
        entry_ = code_.steps.size() - 1;
        leave(region.condition, 2 * region.first);
    }

    // The results go where the merged values are; past that, for those who come from the entry, the defaults.
    void end_region(const Region& region) {
        in_region_ = false;
        for (std::size_t i = 0; i < region.results.size(); ++i) {
            const Id merge = region.last + static_cast<Id>(i);
            operands_[at(merge)] = at_place(scratch_base, take(numbers(merge)));
        }
        copy_to_merges(region, region.results);
        Step& past_defaults = end_step(Step::Then::go_to);
        code_.steps[entry_].target = code_.steps.size();
        past_defaults.target = code_.steps.size() + 1;
        copy_to_merges(region, region.defaults);
        end_step(Step::Then::go_on);
        for (std::size_t i = 0; i < region.results.size(); ++i) {
            leave(region.results[i], 2 * region.last);
            leave(region.defaults[i], 2 * region.last);
            const Id merge = region.last + static_cast<Id>(i);
            if (last_use_[at(merge)] == 0) leave(merge, 0);
        }
    }

    void copy_to_merges(const Region& region, const std::vector<Id>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const Id merge = region.last + static_cast<Id>(i);
            emit(Op::merge, numbers(merge), offset_of(operands_[at(merge)]), operands_[at(values[i])]);
        }
    }

    const Graph& graph_;
    Code<Number> code_;
    Places places_;
    std::vector<Operand> operands_;     // of each node
    std::vector<Id> owner_;             // of the place where it stands: itself, or what it is a part or a result of
    std::vector<Id> last_use_;          // of each owner
    std::vector<Id> order_, position_;  // nodes as they are translated, and the place of each
    std::size_t arguments_ = 0;         // place for those of calls
    bool in_region_ = false;
    std::size_t entry_ = 0;  // step at the open region's begin
};

}  // namespace

template <class Number>
Code<Number> translated(const Graph& graph, int lanes) {
    return Translation<Number>(graph, lanes).code();
}

template Code<double> translated<double>(const Graph& graph, int lanes);
template Code<float> translated<float>(const Graph& graph, int lanes);

}  // namespace hamilcar::program::portable
