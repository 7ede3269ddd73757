#include <algorithm>
#include <map>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/program/portable_code.hpp"

namespace hamilcar::program::portable {

namespace {

std::size_t at(Id id) {
    return static_cast<std::size_t>(id);
}

// Allocates scratch memory; the most recently released is used again first, while it is still in the cache.
class ScratchAllocator {
public:
    std::size_t take(std::size_t numbers) {
        std::vector<std::size_t>& free = free_[numbers];
        if (free.empty()) {
            size_ += numbers;
            return size_ - numbers;
        }
        const std::size_t offset = free.back();
        free.pop_back();
        return offset;
    }
    void release(std::size_t offset, std::size_t numbers) { free_[numbers].push_back(offset); }
    std::size_t size() const { return size_; }

private:
    std::map<std::size_t, std::vector<std::size_t>> free_;  // by numbers
    std::size_t size_ = 0;
};

// From a graph to code. Values occupy scratch memory from where they are computed to their last use; parts are
// stored within their wholes, and the results of a call next to one another.
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
        arguments_ = take(max_arguments());
        auto region = graph_.regions().begin();
        for (Id id = 0; id <= graph_.size(); ++id) {  // also the position in the order, at the borders of regions
            while (region != graph_.regions().end() && (in_region_ ? region->last : region->first) == id) {
                in_region_ ? end_region(*region++) : begin_region(*region);
            }
            if (id < graph_.size()) translate(order_[at(id)]);
        }
        for (const Output& output : graph_.outputs()) {
            HAMILCAR_ASSERT(graph_.node(output.node).width == 1);
            code_.stores.push_back({output.array, at(output.index) * lanes(), operands_[at(output.node)]});
        }
        end_step(Step::Then::go_on);
        code_.scratch_numbers = scratch_.size();
        return std::move(code_);
    }

private:
    // Times: the node at position `i` of the order reads its operands at 2 i + 1; a region that begins before it reads its
    // condition at 2 i, and one that ends there its values likewise.
    Id time_of(Id id) const { return 2 * position_[at(id)] + 1; }

    std::size_t lanes() const { return static_cast<std::size_t>(code_.lanes); }
    std::size_t numbers(Id id) const {  // that an owner stores
        const Node& node = graph_.node(id);
        return lanes() * (node.op == Op::call ? at(graph_.calls()[at(node.a)].result_count) : node.width);
    }
    std::size_t max_arguments() const {
        std::size_t count = 0;
        for (const Call& call : graph_.calls()) count = std::max(count, call.arguments.size());
        return count * lanes();
    }
    std::size_t take(std::size_t numbers) { return numbers == 0 ? 0 : scratch_.take(numbers); }

    void use(Id id, Id time) {
        Id& last = last_use_[at(owner_[at(id)])];
        last = std::max(last, time);
    }

    void find_last_uses() {
        for (Id id = 0; id < graph_.size(); ++id) {
            const Node& node = graph_.node(id);
            owner_[at(id)] = node.op == Op::part || node.op == Op::result ? owner_[at(node.a)] : id;
            const int count = operand_count(node.op);
            if (count > 0) use(node.a, time_of(id));
            if (count > 1 && node.op != Op::part) use(node.b, time_of(id));
            if (count > 2) use(node.c, time_of(id));
            if (node.op == Op::call) {
                for (const Id argument : graph_.calls()[at(node.a)].arguments) use(argument, time_of(id));
            }
        }
        for (const Region& region : graph_.regions()) {
            use(region.condition, 2 * region.first);
            for (const Id id : region.defaults) use(id, 2 * region.last);
            for (const Id id : region.results) use(id, 2 * region.last);
        }
        for (const Output& output : graph_.outputs()) use(output.node, 2 * graph_.size() + 1);
    }

    // After the last use of a value its memory is free.
    void release_if_last(Id id, Id time) {
        const Id owner = owner_[at(id)];
        if (last_use_[at(owner)] != time) return;
        last_use_[at(owner)] = none;
        const Operand operand = operands_[at(owner)];
        if (base_of(operand) == scratch_base && numbers(owner) > 0)
            scratch_.release(offset_of(operand), numbers(owner));
    }

    void emit(Op op, std::size_t numbers, std::size_t result, Operand a, Operand b = 0, Operand c = 0) {
        const Work<Number> how = work<Number>(op, static_cast<int>(numbers));
        const std::size_t here = code_.operations.size();
        if (code_.groups.size() == first_group() || code_.groups.back().work != how)
            code_.groups.push_back({how, here, here});
        ++code_.groups.back().last;
        code_.operations.push_back({static_cast<std::uint32_t>(result), a, b, c});
    }

    // Of the step in progress.
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
            case Op::input: operand = operand_at(arrays_base + at(node.a), at(node.b) * lanes()); return;
            case Op::part:
            case Op::result: operand = operands_[at(node.a)] + static_cast<Operand>(at(node.b) * lanes()); break;
            case Op::merge: return;  // already done at the region's end
            case Op::call: translate_call(id); break;
            default: translate_operation(id);
        }
        release_operands(id);
    }

    void release_operands(Id id) {
        const Node& node = graph_.node(id);
        const int count = operand_count(node.op);
        if (count > 0) release_if_last(node.a, time_of(id));
        if (count > 1 && node.op != Op::part) release_if_last(node.b, time_of(id));
        if (count > 2) release_if_last(node.c, time_of(id));
        if (last_use_[at(id)] == 0) release_if_last(id, 0);  // not used
    }

    void translate_operation(Id id) {
        const Node& node = graph_.node(id);
        const std::size_t offset = take(numbers(id));
        operands_[at(id)] = operand_at(scratch_base, offset);
        const auto operand = [&](Id from) { return from == none ? 0 : operands_[at(from)]; };
        if (node.op == Op::join) {
            emit(node.op, numbers(id) / 2, offset, operand(node.a));
            emit(node.op, numbers(id) / 2, offset + numbers(id) / 2, operand(node.b));
        } else {
            emit(node.op, numbers(id), offset, operand(node.a), operand(node.b), operand(node.c));
        }
    }

    // The same value in every lane; conditions as bits.
    Operand constant(const Node& node) {
        const std::size_t offset = code_.constants.size();
        for (std::size_t i = 0; i < node.width; ++i) {
            const Number value = node.op == Op::truth ? truth_number<Number>(node.a != 0)
                                                      : static_cast<Number>(graph_.constants(node)[i]);
            code_.constants.insert(code_.constants.end(), lanes(), value);
        }
        return operand_at(constants_base, offset);
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
        operands_[at(id)] = operand_at(scratch_base, step.results);
        for (const Id argument : call.arguments) release_if_last(argument, time_of(id));
    }

    void begin_region(const Region& region) {
        in_region_ = true;
        Step& step = end_step(Step::Then::enter_region);
        step.condition = operands_[at(region.condition)];
        step.numbers = static_cast<int>(numbers(region.condition));
        entry_ = code_.steps.size() - 1;
        release_if_last(region.condition, 2 * region.first);
    }

    // Copies the results to the merged values; a jump from the region's entry goes to the copies of the defaults instead.
    void end_region(const Region& region) {
        in_region_ = false;
        for (std::size_t i = 0; i < region.results.size(); ++i) {
            const Id merge = region.last + static_cast<Id>(i);
            operands_[at(merge)] = operand_at(scratch_base, take(numbers(merge)));
        }
        copy_to_merges(region, region.results);
        Step& past_defaults = end_step(Step::Then::go_to);
        code_.steps[entry_].target = code_.steps.size();
        past_defaults.target = code_.steps.size() + 1;
        copy_to_merges(region, region.defaults);
        end_step(Step::Then::go_on);
        for (std::size_t i = 0; i < region.results.size(); ++i) {
            release_if_last(region.results[i], 2 * region.last);
            release_if_last(region.defaults[i], 2 * region.last);
            const Id merge = region.last + static_cast<Id>(i);
            if (last_use_[at(merge)] == 0) release_if_last(merge, 0);
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
    ScratchAllocator scratch_;
    std::vector<Operand> operands_;     // of each node
    std::vector<Id> owner_;             // whose memory it uses: itself, or the node that it is a part or a result of
    std::vector<Id> last_use_;          // of each owner
    std::vector<Id> order_, position_;  // nodes in the order of translation, and the position of each
    std::size_t arguments_ = 0;         // offset of the arguments of calls
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
