#include <algorithm>
#include <array>

#include "hamilcar/program/portable_code.hpp"

namespace hamilcar::program::portable {

namespace {

std::size_t at(Id id) {
    return static_cast<std::size_t>(id);
}

class Order {
public:
    explicit Order(const Graph& graph) : graph_(graph), is_done_(at(graph.size()), false) {
        std::vector<bool> is_border(at(graph.size()) + 1, false);
        for (const Region& region : graph.regions()) is_border[at(region.first)] = is_border[at(region.last)] = true;
        for (Id id = 0; id < graph.size(); ++id) {
            if (graph.node(id).op == Op::call) is_border[at(id)] = is_border[at(id) + 1] = true;
        }
        is_border.back() = true;
        for (Id first = 0, last = 0; last <= graph.size(); ++last) {
            if (!is_border[at(last)]) continue;
            arrange(first, last);
            first = last;
        }
    }
    std::vector<Id> ids() && { return std::move(ids_); }

private:
    static constexpr std::size_t window = 128;  // nodes considered together

    // Equal for operations of one kind; 0 where there is nothing to do.
    int kind(Id id) const {
        const Node& node = graph_.node(id);
        const bool is_free = node.op <= Op::input || node.op == Op::truth || node.op >= Op::part;
        return is_free ? 0 : static_cast<int>(node.op) * 4 + node.width / 2;
    }
    bool is_ready(Id id) const {
        const Node& node = graph_.node(id);
        const int count = node.op == Op::part ? 1 : operand_count(node.op);
        return (count < 1 || is_done_[at(node.a)]) && (count < 2 || is_done_[at(node.b)]) &&
               (count < 3 || is_done_[at(node.c)]);
    }

    void arrange(Id first, Id last) {
        std::vector<Id> waiting;
        while (true) {
            while (first < last && waiting.size() < window) waiting.push_back(first++);
            if (waiting.empty()) return;
            const int kind = most_frequent(waiting);
            std::size_t left = 0;
            for (const Id id : waiting) {
                if (this->kind(id) == kind && is_ready(id)) {
                    ids_.push_back(id);
                    is_done_[at(id)] = true;
                } else {
                    waiting[left++] = id;
                }
            }
            waiting.resize(left);
        }
    }

    // Chooses among the ready nodes; those without work come first.
    int most_frequent(const std::vector<Id>& waiting) const {
        std::array<int, 4 * (static_cast<std::size_t>(Op::merge) + 1)> counts{};
        for (const Id id : waiting) counts[at(kind(id))] += is_ready(id);
        if (counts[0] > 0) return 0;
        return static_cast<int>(std::ranges::max_element(counts) - counts.begin());
    }

    const Graph& graph_;
    std::vector<bool> is_done_;
    std::vector<Id> ids_;
};

}  // namespace

std::vector<Id> order_by_kind(const Graph& graph) {
    return Order(graph).ids();
}

}  // namespace hamilcar::program::portable
