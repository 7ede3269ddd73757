// Sums over the spokes of a car in one order, whatever number carries them: first the spokes at each place of the rows,
// then the places. A car that runs its spokes abreast and one that runs them one by one get the same bits.
#pragma once

#include <array>

#include "hamilcar/vehicle/row.hpp"

namespace hamilcar {

template <class T, class S, std::size_t count>
class PlaceSum {
public:
    using Share = std::array<S, count>;

    template <class Row>
    void add(const Share& share, const Row& row) {
        if constexpr (width == 1) {
            accumulate(static_cast<std::size_t>(row.place), share);
        } else if (row.count == width) {
            accumulate(0, share);
        } else {
            Share own = share;
            for (int vacant = row.count; vacant < width; ++vacant) {
                for (S& number : own) set_lane(number, vacant, T(0));
            }
            accumulate(0, own);
        }
    }

    std::array<T, count> total() {
        for (std::size_t place = 0; place < sums_.size(); ++place) {
            if (!begun_[place]) sums_[place].fill(S(0));
        }
        std::array<T, count> out;
#pragma GCC unroll 32
        for (std::size_t k = 0; k < count; ++k) {
            if constexpr (width == 1) {
                out[k] = sums_[0][k] + sums_[1][k];
            } else {
                out[k] = lane(sums_[0][k], 0) + lane(sums_[0][k], 1);
            }
        }
        return out;
    }

private:
    static constexpr int width = row_width<S, T>;
    static_assert(width == 1 || width == places_abreast);

    void accumulate(std::size_t place, const Share& share) {
        Share& sum = sums_[place];
        if (begun_[place]) {
#pragma GCC unroll 32
            for (std::size_t k = 0; k < count; ++k) sum[k] += share[k];
        } else {
#pragma GCC unroll 32
            for (std::size_t k = 0; k < count; ++k) sum[k] = share[k];
            begun_[place] = true;
        }
    }

    static constexpr std::size_t places = width == 1 ? places_abreast : 1;
    std::array<Share, places> sums_;  // only what is begun has values
    std::array<bool, places> begun_{};
};

}  // namespace hamilcar
