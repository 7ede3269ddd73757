// A page at the other end of a WebSocket. Only for server.cpp.
#pragma once

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <memory>
#include <set>

#include "hamilcar/live/lobby.hpp"

namespace hamilcar::live {

namespace beast = boost::beast;
using Upgrade = beast::http::request<beast::http::empty_body>;

class SocketPage;

// What all connections share: the lobby, how many there are, and the pages to take leave of at the end.
struct House {
    Lobby& lobby;
    int connections = 0;
    std::set<SocketPage*> pages{};
};

// One of the connections, for as long as it is there.
class Seat {
public:
    explicit Seat(House& house) : house_(&house) { ++house.connections; }
    Seat(Seat&& other) noexcept : house_(std::exchange(other.house_, nullptr)) {}
    Seat& operator=(Seat&&) = delete;
    ~Seat() {
        if (house_) --house_->connections;
    }
    House& house() const { return *house_; }

private:
    House* house_;
};

class SocketPage final : public Page, public std::enable_shared_from_this<SocketPage> {
public:
    SocketPage(beast::tcp_stream stream, Seat seat) : stream_(std::move(stream)), seat_(std::move(seat)) {}

    void accept(Upgrade request) {
        constexpr auto to_shake_hands = std::chrono::seconds(5), to_be_silent = std::chrono::seconds(30);
        constexpr std::size_t longest_message = 4096;
        stream_.set_option(beast::websocket::stream_base::timeout{to_shake_hands, to_be_silent, true});
        stream_.read_message_max(longest_message);
        stream_.auto_fragment(false);
        request_ = std::move(request);
        stream_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
            if (!error) self->enter();
        });
    }

    void tell(Message text) override { put({std::move(text), false}); }
    void give(Message tile) override { put({std::move(tile), true}); }
    void show(Message frame) override {
        if (std::exchange(frame_, std::move(frame))) ++lost_frames_;
        write();
    }
    bool has_room() const override { return queue_.size() < room_for_tiles; }
    long lost_frames() const override { return lost_frames_; }
    void turn_out(const char* reason) override { close({beast::websocket::close_code::policy_error, reason}); }
    void take_leave() { close(beast::websocket::close_code::going_away); }

private:
    static constexpr std::size_t room_for_tiles = 4, most_waiting = 64;
    struct Outgoing {
        Message message;
        bool binary;
    };

    void enter() {
        seat_.house().pages.insert(this);
        number_ = seat_.house().lobby.enter(*this);
        read();
    }

    void read() {
        stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (error) return self->leave();
            const std::string text = beast::buffers_to_string(self->buffer_.data());
            self->buffer_.consume(self->buffer_.size());
            if (!self->closing_) self->seat_.house().lobby.hear(self->number_, self->stream_.got_text() ? text : "");
            self->read();
        });
    }

    void leave() {
        closing_ = true;
        seat_.house().pages.erase(this);
        seat_.house().lobby.leave(number_);
        stream_.next_layer().close();
    }

    // A page that has not read for so long will not read a reason either.
    void put(Outgoing message) {
        if (queue_.size() >= most_waiting) return stream_.next_layer().close();
        queue_.push_back(std::move(message));
        write();
    }

    void write() {
        if (writing_ || closing_ || (queue_.empty() && !frame_)) return;
        Outgoing next{frame_, true};
        if (queue_.empty()) {
            frame_ = nullptr;
        } else {
            next = std::move(queue_.front());
            queue_.pop_front();
        }
        writing_ = true;
        stream_.binary(next.binary);
        const auto bytes = boost::asio::buffer(*next.message);
        stream_.async_write(bytes, [self = shared_from_this(), next](beast::error_code error, std::size_t) {
            self->writing_ = false;
            if (!error) self->write();
        });
    }

    void close(const beast::websocket::close_reason& reason) {
        if (std::exchange(closing_, true)) return;
        stream_.async_close(reason, [self = shared_from_this()](beast::error_code) {});
    }

    beast::websocket::stream<beast::tcp_stream> stream_;
    Seat seat_;
    Upgrade request_;
    beast::flat_buffer buffer_;
    std::uint32_t number_ = 0;
    std::deque<Outgoing> queue_;
    Message frame_;
    bool writing_ = false, closing_ = false;
    long lost_frames_ = 0;
};

}  // namespace hamilcar::live
