// The server on a real socket: responses, and isolation of pages from a misbehaving one.
#include "hamilcar/live/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <functional>

#include "hamilcar/live/connections.hpp"
#include "live/socket_client.hpp"
#include "live/test_catalog.hpp"

namespace hamilcar::live {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string page =
    "<!doctype html><title>Drive</title><meta http-equiv=\"Content-Security-Policy\" "
    "content=\"script-src 'sha256-x='; style-src 'sha256-y='\" />";

class LiveServer : public testing::Test {
protected:
    void SetUp() override {
        thread =
            std::jthread([this](const std::stop_token& stop) { server.run([&] { return stop.stop_requested(); }); });
        entrance = get(target_of(server.url()));
    }
    void TearDown() override { stop(); }
    void stop() {
        if (!thread.joinable()) return;
        thread.request_stop();
        thread.join();
    }

    static std::string target_of(const std::string& url) { return url.substr(url.find("/?")); }
    std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }
    std::string answer(const std::string& request) const {
        SocketClient client(server.port());
        client.send(request);
        return client.rest();
    }
    std::string get(const std::string& target, const std::string& method = "GET", std::string from = "") const {
        if (from.empty()) from = host();
        return answer(method + " " + target + " HTTP/1.1\r\nHost: " + from + "\r\n\r\n");
    }
    // What the entrance tells a browser: where the page is, and the cookie that opens it.
    std::string path() const { return part_of(entrance, "; Path="); }
    std::string cookie() const { return part_of(entrance, "Set-Cookie: "); }
    static std::string part_of(const std::string& text, const std::string& start) {
        const std::size_t from = std::min(text.find(start), text.size() - start.size()) + start.size();
        return text.substr(from, text.find_first_of(";\r", from) - from);
    }
    std::string get_page(const std::string& method = "GET", const std::string& path_end = "") const {
        return answer(method + " " + path() + path_end + " HTTP/1.1\r\nHost: " + host() + "\r\nCookie: " + cookie() +
                      "\r\n\r\n");
    }
    std::string upgrade(const std::string& cookie, const std::string& origin) const {
        return "GET " + path() + "live HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: " + origin +
               "\r\nCookie: " + cookie +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    }
    // A page that is connected and has received its hello.
    SocketClient connected(int receive_buffer = 0) const {
        SocketClient client(server.port(), receive_buffer);
        client.send(upgrade(cookie(), "http://" + host()));
        EXPECT_THAT(client.header(), HasSubstr("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));  // the answer of RFC 6455
        EXPECT_THAT(client.text_with("\"hello\""), HasSubstr("generator"));
        return client;
    }

    std::vector<std::string> lines;
    Session session{test_catalog(), {"car", "flat"}, scratch_folder()};
    Server server{session, {page, 0, [this](const std::string& line) { lines.push_back(line); }}};
    std::jthread thread;
    std::string entrance;  // its answer
};

TEST_F(LiveServer, LeadsFromTheEntranceToThePage) {
    EXPECT_EQ(server.url().substr(0, server.url().size() - 32), "http://" + host() + "/?token=");
    EXPECT_THAT(entrance, StartsWith("HTTP/1.1 200 "));
    EXPECT_THAT(entrance, HasSubstr("0; url=" + path()));
    EXPECT_THAT(entrance, HasSubstr("HttpOnly; SameSite=Strict"));
    EXPECT_THAT(entrance, testing::Not(HasSubstr("script-src")));
    const std::string found = get_page();
    EXPECT_THAT(found, StartsWith("HTTP/1.1 200 "));
    EXPECT_THAT(found, HasSubstr("\r\n\r\n" + page));
    for (const char* header : {"text/html", "nosniff", "no-referrer", "no-store", "default-src 'none'",
                               "script-src 'sha256-x='; style-src 'sha256-y='"}) {
        EXPECT_THAT(found, HasSubstr(header));
    }
    EXPECT_THAT(found, HasSubstr("ws://" + host()));
    EXPECT_THAT(found, testing::Not(HasSubstr("unsafe")));
    EXPECT_THAT(found, testing::Not(HasSubstr("Set-Cookie")));
    const std::string head = get_page("HEAD");
    EXPECT_THAT(head, HasSubstr("Content-Length: " + std::to_string(page.size())));
    EXPECT_THAT(head, testing::EndsWith("\r\n\r\n"));
    EXPECT_EQ(get_page(), found);  // again and again, as a reload and a further page do
    EXPECT_EQ(get(target_of(server.url())), entrance);
}

TEST_F(LiveServer, LetsItsOwnBrowserInOnce) {
    const std::string target = target_of(server.url_once());
    EXPECT_NE(target, target_of(server.url()));
    EXPECT_THAT(get(target, "HEAD"), StartsWith("HTTP/1.1 200 "));
    EXPECT_EQ(get(target), entrance);
    EXPECT_THAT(get(target), StartsWith("HTTP/1.1 403 "));
}

TEST_F(LiveServer, RejectsUnauthorizedRequests) {
    const std::string with_token = target_of(server.url()).substr(1);
    EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/?token=0123"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/?token=0123"), HasSubstr("open the address that it printed."));
    EXPECT_THAT(get(path() + with_token), StartsWith("HTTP/1.1 403 "));  // no cookie
    EXPECT_THAT(get("/" + with_token, "GET", "evil.example"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/favicon.ico" + with_token), StartsWith("HTTP/1.1 404 "));
    EXPECT_THAT(get("/" + with_token, "POST"), StartsWith("HTTP/1.1 405 "));
    EXPECT_THAT(answer(upgrade(cookie(), "http://evil.example")), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer(upgrade("hamilcar=0123", "http://" + host())), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get_page("GET", "live"), StartsWith("HTTP/1.1 403 "));  // no Origin
    EXPECT_EQ(answer("nonsense\r\n\r\n"), "");
    EXPECT_EQ(answer(std::string(20000, 'x')), "");
    const std::string twice = "GET /" + with_token + " HTTP/1.1\r\nHost: " + host() + "\r\nHost: evil.example\r\n\r\n";
    EXPECT_THAT(answer(twice), StartsWith("HTTP/1.1 403 "));
}

TEST_F(LiveServer, ServesDriverAndViewer) {
    SocketClient driver = connected(), watcher = connected();
    driver.send_text(
        R"({"type":"input","sequence":42,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
    watcher.send_text(R"({"type":"reset"})");
    EXPECT_THAT(watcher.text_with("refusal"), HasSubstr("Page 1 has control; this page is a viewer."));
    bool arrived = false;
    for (auto frame = watcher.frame(); frame && !arrived; frame = watcher.frame()) {
        arrived = frame->opcode == 2 && frame->payload.at(0) == 1 && frame->payload.at(16) == 42;
    }
    EXPECT_TRUE(arrived);
    { const SocketClient gone = std::move(driver); }
    EXPECT_NE(watcher.text_with("\"status\"", R"("paused":"nobody")"), "");
    watcher.send_text(R"({"type":"take"})");
    EXPECT_NE(watcher.text_with("\"status\"", R"("driver":2)"), "");
    EXPECT_NE(watcher.text_with("\"status\"", R"("paused":"")"), "");
}

TEST_F(LiveServer, DisconnectsAfterLargeOrInvalidMessages) {
    SocketClient good = connected(), oversized = connected(), invalid = connected();
    oversized.send_text(std::string(5000, ' '));
    EXPECT_EQ(oversized.close_code(), 1009);
    for (int i = 0; i < Connections::max_invalid_messages; ++i) invalid.send_frame(i % 2 ? 1 : 2, "{\"type\":");
    EXPECT_NE(invalid.text_with("refusal"), "");
    EXPECT_EQ(invalid.close_code(), 1008);
    EXPECT_NE(good.text_with("\"status\"", R"("pages":1)"), "");
}

// Who knows no secret keeps those out who do neither by waiting nor by coming again and again.
TEST_F(LiveServer, KeepsItsSeatsForThoseWithTheToken) {
    std::vector<SocketClient> waiting;
    for (int i = 0; i < 300; ++i) waiting.emplace_back(server.port());
    EXPECT_THAT(get(target_of(server.url())), StartsWith("HTTP/1.1 200 "));
    SocketClient driver = connected();
    std::jthread flood([port = server.port()](const std::stop_token& stop) {
        std::deque<SocketClient> held;
        while (!stop.stop_requested()) {
            held.emplace_back(port).send("GET / HTTP/1.1\r\nX: ");
            if (held.size() > 64) held.pop_front();
        }
    });
    for (int i = 0; i < 20; ++i) EXPECT_THAT(get_page(), StartsWith("HTTP/1.1 200 ")) << i;
    SocketClient watcher = connected();
    EXPECT_NE(watcher.text_with("\"status\"", R"("pages":2)"), "");
    EXPECT_NE(driver.text_with("\"status\"", R"("pages":2)"), "");  // the flood did not throw it out
}

// The steps know nothing of the network: how many of them are late is the machine's doing, not that of who is connected.
TEST_F(LiveServer, NeitherFloodNorSlowReadersDelaySteps) {
    SocketClient driver = connected();
    ASSERT_NE(driver.text_with("\"status\"", R"("paused":"")"), "");
    const auto number = [](const std::string& status, const std::string& name) {
        const std::size_t at = status.find("\"" + name + "\":");
        return at == status.npos ? 0.0 : std::stod(status.substr(at + name.size() + 3));
    };
    // Of the steps of a second and a half, how many began more than a period late.
    const auto share_of_late = [&](const std::function<void()>& meanwhile) {
        const std::string before = driver.text_with("\"status\"");
        std::string after = before;
        while (after != "" && number(after, "time") < number(before, "time") + 1.5) {
            meanwhile();
            after = driver.text_with("\"status\"");
        }
        const double steps = number(after, "steps") - number(before, "steps");
        EXPECT_NEAR(number(after, "time") - number(before, "time"), 1e-3 * steps, 1e-6);  // none is left out
        return (number(after, "overruns") - number(before, "overruns")) / steps;
    };
    const double quiet = share_of_late([] {});
    std::vector<SocketClient> slow;
    for (int i = 0; i < 8; ++i) slow.push_back(connected(4096));
    const double flooded = share_of_late([&] {
        for (int i = 0; i < 500; ++i) {
            driver.send_text(
                R"({"type":"input","sequence":1,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
            driver.send_text(R"({"type":"pause","on":false})");
            if (i < 8) slow[static_cast<std::size_t>(i)].send_text(R"({"type":"reset"})");
            const SocketClient idle(server.port());
        }
    });
    EXPECT_LT(flooded, quiet + 0.5);
}

TEST_F(LiveServer, SlowPageDoesNotAffectOthers) {
    SocketClient good = connected();
    good.send_text(R"({"type":"load","vehicle":"car","road":"waves","friction":1})");  // tiles fill a queue sooner
    ASSERT_NE(good.text_with("\"waves\""), "");
    SocketClient slow = connected(4096);
    std::uint32_t frames = 0;
    std::string status;
    constexpr std::uint32_t many = 300;  // several seconds; together with the tiles more than the system's buffers hold
    for (auto frame = good.frame(); frame && frames < many; frame = good.frame()) {
        if (frame->opcode == 2 && frame->payload.at(0) == 1) ++frames;
        if (frame->opcode == 1) status = frame->payload;
    }
    EXPECT_EQ(frames, many);
    EXPECT_THAT(status, HasSubstr(R"("pages":2)"));
    std::string late = slow.text_with("\"status\"");
    while (late.find(R"("lost_frames":0)") != std::string::npos) late = slow.text_with("\"status\"");
    EXPECT_THAT(late, HasSubstr("lost_frames"));
}

TEST_F(LiveServer, AcceptsAtMostSixteenPages) {
    std::vector<SocketClient> pages;
    for (int i = 0; i < 16; ++i) pages.push_back(connected());
    EXPECT_THAT(answer(upgrade(cookie(), "http://" + host())), StartsWith("HTTP/1.1 503 "));
    pages.pop_back();
    EXPECT_TRUE(becomes_true([&] {
        SocketClient client(server.port());
        client.send(upgrade(cookie(), "http://" + host()));
        return client.header().starts_with("HTTP/1.1 101 ");
    }));
}

TEST_F(LiveServer, ClosesConnectionsOnShutdown) {
    SocketClient client = connected();
    stop();
    EXPECT_EQ(client.close_code(), 1001);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0], HasSubstr("steps"));
}

TEST(Server, FailsOnOccupiedPort) {
    Session session(test_catalog(), {"car", "flat"}, scratch_folder());
    const Server server(session, {page});
    EXPECT_THROW(Server(session, {page, server.port()}), io::Error);
}

}  // namespace
}  // namespace hamilcar::live
