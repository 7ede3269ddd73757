// Units as factors to SI, against their definitions.
#include "hamilcar/base/units.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hamilcar::units {
namespace {

constexpr Quantity quantities[] = {Quantity::length, Quantity::force,    Quantity::angle,       Quantity::mass,
                                   Quantity::time,   Quantity::pressure, Quantity::temperature, Quantity::power};

TEST(Units, OfAQuantityStandTogetherWithTheSiUnitFirst) {
    std::size_t count = 0;
    for (const Quantity quantity : quantities) {
        ASSERT_FALSE(of(quantity).empty());
        EXPECT_EQ(of(quantity).front().to_si, 1);
        for (const Unit& unit : of(quantity)) EXPECT_EQ(unit.quantity, quantity);
        count += of(quantity).size();
    }
    EXPECT_EQ(count, 41u);
}

TEST(Units, HaveSpellingsAndSymbolsOfTheirOwn) {
    std::set<std::string_view> symbols;
    for (const Quantity quantity : quantities) {
        for (const Unit& unit : of(quantity)) {
            EXPECT_EQ(find(quantity, unit.name()), &unit);
            EXPECT_TRUE(unit.symbol.empty() || symbols.insert(unit.symbol).second) << unit.symbol;
        }
    }
}

TEST(Units, AreFoundInAnyCase) {
    ASSERT_NE(find(Quantity::length, "MM"), nullptr);
    EXPECT_EQ(find(Quantity::length, "MM")->to_si, 1e-3);
    EXPECT_EQ(find(Quantity::length, "kg"), nullptr);
    EXPECT_EQ(find(Quantity::length, ""), nullptr);
    EXPECT_DOUBLE_EQ(find(Quantity::pressure, "psi")->to_si, 6894.757293168361);  // NIST SP 811
}

TEST(Units, MakeProducts) {
    const auto expect = [](std::string_view symbols, const std::string& si, double to_si) {
        const auto found = product(symbols);
        ASSERT_TRUE(found) << symbols;
        EXPECT_EQ(found->si, si) << symbols;
        EXPECT_DOUBLE_EQ(found->to_si, to_si) << symbols;
    };
    expect("", "", 1);
    expect("-", "", 1);
    expect("%", "", 0.01);
    expect("km/h", "m/s", 1 / 3.6);
    expect("Nm", "N m", 1);
    expect("kN m", "N m", 1000);
    expect("deg/s", "rad/s", degree);
    expect("N m/deg", "N m/rad", 1 / degree);
    for (const char* unknown : {"parsec", "m/s/s", "m//s", "m  s", "M"}) EXPECT_FALSE(product(unknown)) << unknown;
}

}  // namespace
}  // namespace hamilcar::units
