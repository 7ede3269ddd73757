// Spokes abreast: spokes of one kind stand side by side in the lanes of a number, so that the two wheels of an axle cost
// little more than one. A lane computes what the spoke alone would, bit for bit.
#pragma once

#include <array>
#include <vector>

#include "hamilcar/math/gather.hpp"
#include "hamilcar/math/traced.hpp"

namespace hamilcar {

// The number that carries spokes abreast: for a number that records a pair, which a program computes side by side; for all
// others there is none, and spokes come one by one.
template <class T>
struct AbreastNumber {
    using type = T;
};
template <class E>
struct AbreastNumber<Traced<E>> {
    using type = Traced<E, 2>;
};
template <class T>
using Abreast = typename AbreastNumber<T>::type;

// How many numbers T stand abreast in an S.
template <class S, class T>
inline constexpr int row_width = lane_count<S> / lane_count<T>;

// The i-th of the numbers T abreast in an S.
template <class T, class S>
T at_place(const S& row, int i) {
    if constexpr (row_width<S, T> == 1) {
        return row;
    } else {
        return lane(row, i);
    }
}

// The numbers at the places of a row, side by side.
template <class S, class Numbers, class Index>
S from_places(const Numbers& numbers, const Index& index) {
    using T = typename Numbers::value_type;
    constexpr std::size_t width = row_width<S, T>;
    if constexpr (width == 1) {
        return numbers[static_cast<std::size_t>(index[0])];
    } else {
        std::array<T, width> abreast;
        for (std::size_t i = 0; i < width; ++i) abreast[i] = numbers[static_cast<std::size_t>(index[i])];
        return S(abreast);
    }
}

// The same in every lane.
template <class S, class T, int rows, int columns>
Matrix<S, rows, columns> abreast(const Matrix<T, rows, columns>& same) {
    Matrix<S, rows, columns> out;
    for (int i = 0; i < rows * columns; ++i) out.data()[i] = S(same.data()[i]);
    return out;
}

// Places of a row, whether the number at hand has lanes for them or not: the order of sums depends on it.
inline constexpr int places_abreast = 2;
using RowIndex = std::array<int, places_abreast>;

// Spokes of one kind side by side, with their numbers in the car; places beyond `count` repeat the first. Where a spoke
// runs alone it is the first of its row, and `place` tells where it would stand.
template <class Spokes>
struct Row {
    Spokes spokes;
    RowIndex index{};
    int count = 0;
    int place = 0;
};

// Neighbors of one kind share a row: the place of each spoke.
template <class Spoke>
std::vector<int> places_of(const std::vector<Spoke>& spokes) {
    std::vector<int> places;
    for (std::size_t i = 0; i < spokes.size(); ++i) {
        const bool joins = i > 0 && places[i - 1] + 1 < places_abreast &&
                           spokes[i].suspension.index() == spokes[i - 1].suspension.index() &&
                           spokes[i].tire.index() == spokes[i - 1].tire.index();
        places.push_back(joins ? places[i - 1] + 1 : 0);
    }
    return places;
}

template <class S, template <class> class Spoke, class T>
std::vector<Row<Spoke<S>>> in_rows(const std::vector<Spoke<T>>& spokes, const std::vector<int>& places) {
    constexpr std::size_t width = row_width<S, T>;
    static_assert(width == places_abreast);
    std::vector<Row<Spoke<S>>> rows;
    for (std::size_t first = 0; first < spokes.size();) {
        Row<Spoke<S>>& row = rows.emplace_back();
        std::array<const Spoke<T>*, width> abreast;
        abreast.fill(&spokes[first]);
        row.index.fill(static_cast<int>(first));
        for (std::size_t i = 0; first + i < spokes.size() && places[first + i] == static_cast<int>(i);
             ++i, ++row.count) {
            abreast[i] = &spokes[first + i];
            row.index[i] = static_cast<int>(first + i);
        }
        gather(row.spokes, abreast);
        first += static_cast<std::size_t>(row.count);
    }
    return rows;
}

}  // namespace hamilcar
