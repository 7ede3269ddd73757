// Keys that are typed over a file's.
#include "hamilcar/io/set_key.hpp"

#include <gtest/gtest.h>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "support/paths.hpp"

namespace hamilcar {
namespace {

io::Node shipped() {
    return io::read_toml(test::source_path("vehicles/bmw_323i.toml"));
}
VehicleDescription read_with(const std::string& assignment) {
    io::Node document = shipped();
    io::set_key(document, assignment, "--vehicle-set");
    return io::read_vehicle(document);
}
std::string complaint(const std::string& assignment) {
    try {
        read_with(assignment);
    } catch (const io::Error& error) {
        return error.what();
    }
    return "";
}

TEST(SetKey, PutsAnotherNumberInItsPlace) {
    const VehicleDescription is = io::read_vehicle(test::source_path("vehicles/bmw_323i.toml"));
    EXPECT_EQ(read_with("chassis.mass_kg=1234.5").chassis.mass, 1234.5);
    EXPECT_NE(is.chassis.mass, 1234.5);
    for (const char* key :
         {"axle[front].spring.rate_N_per_m", "axle.front.spring.rate_N_per_m", "axle[0].spring.rate_N_per_m"}) {
        const VehicleDescription set = read_with(std::string(key) + "=31e3");
        EXPECT_EQ(set.suspensions[0].springs[0].spring.rate, 31e3) << key;
        EXPECT_EQ(set.suspensions[2].springs[0].spring.rate, is.suspensions[2].springs[0].spring.rate) << key;
    }
    EXPECT_EQ(read_with("chassis.center_of_mass_m[2]=0.6").chassis.center_of_mass[2], 0.6);
    EXPECT_EQ(read_with("chassis.center_of_mass_m=[-1.2, 0, 0.6]").chassis.center_of_mass, (Point{-1.2, 0, 0.6}));
}

TEST(SetKey, TakesTextsWithoutQuotationMarks) {
    EXPECT_EQ(read_with("name=Mine").name, "Mine");
    EXPECT_EQ(read_with("name=\"Mine\"").name, "Mine");
    EXPECT_EQ(read_with("name=the blue one").name, "the blue one");
}

// What the file says otherwise about the same thing is overridden, as by a file that starts from it.
TEST(SetKey, OverridesAnotherWayToSayIt) {
    const VehicleDescription set = read_with("aerodynamics.drag_area_m2=0.5");
    EXPECT_EQ(set.aerodynamics.drag_area, 0.5);
}

TEST(SetKey, ComplaintsSayWhatWasTyped) {
    EXPECT_EQ(complaint("chassis.mass_kg=-3"),
              "--vehicle-set: key 'chassis.mass_kg' = -3: expected a positive number [kg]");
    EXPECT_EQ(complaint("chassis.mass_kg=heavy"),
              "--vehicle-set: key 'chassis.mass_kg' = heavy: expected a positive number [kg]");
    EXPECT_EQ(complaint("chassis.mas_kg=3"),
              "--vehicle-set: key 'chassis.mas_kg' = 3 is unknown: did you mean 'mass_kg'?");
    EXPECT_EQ(
        complaint("axle[frnt].spring.rate_N_per_m=3"),
        "--vehicle-set 'axle[frnt].spring.rate_N_per_m=3': 'axle' has no 'frnt': expected one of 'front' or 'rear'");
    for (const char* typed : {"", "=3", "chassis.mass_kg", "chassis.mass_kg=", "chassis.=3", ".mass_kg=3", "axle[=3",
                              "axle[]=3", "axle[front=3", "chassis..mass_kg=3"}) {
        EXPECT_NE(complaint(typed).find("expected KEY=VALUE"), std::string::npos) << typed << ": " << complaint(typed);
    }
}

// Text cannot become more keys than the one, nor deep nests.
TEST(SetKey, SetsOneKeyOnly) {
    EXPECT_NE(complaint("chassis.mass_kg=3\nname = \"x\"").find("expected a positive number"), std::string::npos);
    EXPECT_NE(complaint("chassis.mass_kg=" + std::string(5000, '[')).find("expected a positive number"),
              std::string::npos);
    EXPECT_NE(
        complaint(std::string("a.").append(40, 'b') + ".c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r=1").find("at most 16 parts"),
        std::string::npos);
}

}  // namespace
}  // namespace hamilcar
