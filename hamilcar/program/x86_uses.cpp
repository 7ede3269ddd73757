#if defined(__x86_64__)

#include "hamilcar/program/x86_uses.hpp"

#include <numeric>

namespace hamilcar::program::x86 {

// In the order in which the code is written: `visit(region, value, position)`, with region -1 on the main line.
template <class Visit>
void UseLists::for_each_use(const Graph& graph, const Visit& visit) {
    const auto visit_nodes = [&](int region, Id first, Id last) {
        for (Id id = first; id < last; ++id) {
            for_each_operand(graph, graph.node(id), [&](Id operand) { visit(region, operand, id); });
        }
    };
    Id done = 0;
    int index = 0;
    for (const Region& region : graph.regions()) {
        visit_nodes(-1, done, region.first);
        visit(-1, region.condition, region.first);
        for (const Id value : region.defaults) visit(-1, value, region.first);
        visit_nodes(index, region.first, region.last);
        for (const Id value : region.results) visit(index, value, region.last);
        done = region.last;
        ++index;
    }
    visit_nodes(-1, done, graph.size());
}

UseLists::UseLists(const Graph& graph) {
    const auto size = static_cast<std::size_t>(graph.size());
    for (List& list : lists_) list.ends.assign(size, 0);
    last_regions_.assign(size, -1);
    for_each_use(graph, [&](int region, Id id, int) {
        ++lists_[region >= 0].ends[static_cast<std::size_t>(id)];
        if (region >= 0) last_regions_[static_cast<std::size_t>(id)] = region;
    });
    for (List& list : lists_) {
        std::partial_sum(list.ends.begin(), list.ends.end(), list.ends.begin());
        list.positions.resize(size == 0 ? 0 : static_cast<std::size_t>(list.ends.back()));
        list.cursors.assign(size, 0);
        for (std::size_t i = 1; i < size; ++i) list.cursors[i] = list.ends[i - 1];
    }
    std::vector<int> filled[2] = {lists_[0].cursors, lists_[1].cursors};
    for_each_use(graph, [&](int region, Id id, int position) {
        int& at = filled[region >= 0][static_cast<std::size_t>(id)];
        lists_[region >= 0].positions[static_cast<std::size_t>(at++)] = position;
    });
}

}  // namespace hamilcar::program::x86

#endif
