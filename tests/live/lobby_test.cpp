// Who drives and who watches, told to pages that are only pretended.
#include "hamilcar/live/lobby.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "live/garage.hpp"

namespace hamilcar::live {
namespace {

using testing::Contains;
using testing::HasSubstr;

class PretendedPage final : public Page {
public:
    void tell(Message text) override { texts.push_back(*text); }
    void show(Message) override { ++frames; }
    void give(Message tile) override { tiles.push_back(*tile); }
    bool has_room() const override { return room; }
    long lost_frames() const override { return 7; }
    void turn_out(const char*) override { ++turned_out; }

    std::string last() const { return texts.empty() ? "" : texts.back(); }
    std::vector<std::string> texts, tiles;
    int frames = 0, turned_out = 0;
    bool room = true;
};

class InTheLobby : public testing::Test {
protected:
    bool comes_to(Pause pause) {
        return comes_true([&] { return lobby.attend(), session.progress().paused == pause; });
    }
    Session session{garage(), {"car", "flat"}, scratch_folder()};
    Lobby lobby{session};
    PretendedPage first, second;
};

TEST_F(InTheLobby, TheFirstPageDrivesAndTheOthersWatch) {
    EXPECT_EQ(lobby.enter(first), 1u);
    EXPECT_EQ(lobby.enter(second), 2u);
    ASSERT_GE(second.texts.size(), 3u);
    EXPECT_THAT(second.texts[0], HasSubstr(R"("type":"hello")"));
    EXPECT_THAT(second.texts[0], HasSubstr(R"("page":2)"));
    EXPECT_THAT(second.texts[1], HasSubstr(R"("type":"car")"));
    EXPECT_THAT(second.texts[2], HasSubstr(R"("driver":1)"));
    EXPECT_THAT(second.texts[2], HasSubstr(R"("pages":2)"));
    EXPECT_THAT(second.texts[2], HasSubstr(R"("lost_frames":7)"));
    EXPECT_TRUE(comes_to(Pause::none));
    EXPECT_TRUE(comes_true([&] { return lobby.attend(), first.frames > 5 && second.frames > 5; }));
}

TEST_F(InTheLobby, OnlyTheDriversWishesAreGranted) {
    lobby.enter(first), lobby.enter(second);
    lobby.hear(2, R"({"type":"pause","on":true})");
    EXPECT_THAT(second.last(), HasSubstr("Page 1 drives"));
    lobby.hear(2, R"({"type":"take"})");
    EXPECT_THAT(second.last(), HasSubstr("Page 1 drives"));
    const auto texts = second.texts.size();
    lobby.hear(2, R"({"type":"input","sequence":1,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
    EXPECT_EQ(second.texts.size(), texts);  // not heard, and not worth a word
    lobby.hear(1, R"({"type":"take"})");
    EXPECT_THAT(first.texts, Not(Contains(HasSubstr("refusal"))));
    lobby.hear(1, R"({"type":"pause","on":true})");
    EXPECT_TRUE(comes_to(Pause::driver));
}

TEST_F(InTheLobby, TheCarWaitsForAnotherDriverWhenItsOwnHasLeft) {
    lobby.enter(first), lobby.enter(second);
    ASSERT_TRUE(comes_to(Pause::none));
    lobby.leave(1);
    EXPECT_TRUE(comes_to(Pause::nobody));
    EXPECT_THAT(second.last(), HasSubstr(R"("driver":0)"));
    lobby.hear(2, R"({"type":"reset"})");
    EXPECT_THAT(second.last(), HasSubstr("Take the wheel first."));
    lobby.hear(2, R"({"type":"take"})");
    EXPECT_THAT(second.last(), HasSubstr(R"("driver":2)"));
    EXPECT_TRUE(comes_to(Pause::none));
    lobby.leave(2);
    EXPECT_TRUE(comes_to(Pause::nobody));
    PretendedPage third;
    lobby.enter(third);
    EXPECT_THAT(third.last(), HasSubstr(R"("driver":3)"));
    lobby.leave(3);
}

TEST_F(InTheLobby, WhoMakesNoSenseTwentyTimesIsTurnedOut) {
    lobby.enter(first);
    for (int i = 0; i < Lobby::patience - 1; ++i) lobby.hear(1, "what");
    EXPECT_THAT(first.last(), HasSubstr("refusal"));
    lobby.hear(1, R"({"type":"pause","on":false})");  // and it begins anew
    for (int i = 0; i < Lobby::patience - 1; ++i) lobby.hear(1, "what");
    EXPECT_EQ(first.turned_out, 0);
    lobby.hear(1, "what");
    EXPECT_EQ(first.turned_out, 1);
}

TEST_F(InTheLobby, EverybodyIsToldOfAnotherCarAndOneOfARefusal) {
    lobby.enter(first), lobby.enter(second);
    for (const char* unknown : {R"({"type":"load","vehicle":"boat","road":"flat","friction":1})",
                                R"({"type":"load","vehicle":"car","road":"sea","friction":1})"}) {
        lobby.hear(1, unknown);
        EXPECT_THAT(first.last(), HasSubstr("There is no"));
    }
    lobby.hear(1, R"({"type":"load","vehicle":"wreck","road":"flat","friction":1})");
    EXPECT_TRUE(comes_true([&] { return lobby.attend(), first.last().find("no wheels") != std::string::npos; }));
    EXPECT_THAT(second.texts, Not(Contains(HasSubstr("refusal"))));
    lobby.hear(1, R"({"type":"load","vehicle":"car","road":"waves","friction":0.5})");
    EXPECT_TRUE(
        comes_true([&] { return lobby.attend(), second.last().find(R"("road":"waves")") != std::string::npos; }));
}

TEST_F(InTheLobby, AResultIsToldOnceAndToPagesThatComeLater) {
    lobby.enter(first);
    session.load({"car", "gates"}, 1);
    ASSERT_TRUE(comes_true([&] { return lobby.attend(), session.ride().course() != nullptr; }));
    EXPECT_THAT(first.last(), HasSubstr(R"("title":"Gates")"));
    const auto results = [](const PretendedPage& page) {
        return std::count_if(page.texts.begin(), page.texts.end(), [](const std::string& text) {
            return text.find(R"("type":"result")") != std::string::npos;
        });
    };
    lobby.hear(1, R"({"type":"input","sequence":1,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
    ASSERT_TRUE(comes_true([&] { return lobby.attend(), results(first) > 0; }));
    const std::string told = first.last();
    EXPECT_THAT(told, HasSubstr(R"("passed":true)"));
    lobby.enter(second);
    EXPECT_EQ(second.last(), told);
    const int frames = first.frames;
    ASSERT_TRUE(comes_true([&] { return lobby.attend(), first.frames > frames + 10; }));
    EXPECT_EQ(results(first), 1);
    lobby.hear(1, R"({"type":"reset"})");
    ASSERT_TRUE(comes_true([&] { return lobby.attend(), !session.ride().frames().value().run.over; }));
    PretendedPage third;
    lobby.enter(third);
    EXPECT_EQ(results(third), 0);
    lobby.leave(3);
}

TEST_F(InTheLobby, TilesOfAnUnevenRoadGoToEachPageOnce) {
    lobby.enter(first);
    lobby.hand_out_tiles();
    EXPECT_TRUE(first.tiles.empty());  // the road is flat
    session.load({"car", "waves"}, 1);
    ASSERT_TRUE(comes_true([&] { return lobby.attend(), session.ride().uneven(); }));
    session.pause(true);
    lobby.enter(second);
    second.room = false;
    for (int i = 0; i < 40; ++i) lobby.hand_out_tiles();
    const std::size_t near = tiles_near(0, 0, 48).size();
    EXPECT_GE(first.tiles.size(), near);
    EXPECT_LE(first.tiles.size(), near + 10);  // it may have rolled a little
    EXPECT_EQ(std::set<std::string>(first.tiles.begin(), first.tiles.end()).size(), first.tiles.size());
    EXPECT_TRUE(second.tiles.empty());
    second.room = true;
    lobby.hand_out_tiles();
    EXPECT_EQ(second.tiles.size(), first.tiles.size());  // they are made already
}

TEST(TilesNear, AreAllWithinReachTheNearestFirst) {
    const auto places = tiles_near(8, 8, 20);
    EXPECT_EQ(places.front(), TilePlace(0, 0));
    EXPECT_EQ(places.size(), 9u);
    EXPECT_EQ(tiles_near(-0.1, 0.1, 0.05), std::vector<TilePlace>{TilePlace(-1, 0)});
}

}  // namespace
}  // namespace hamilcar::live
