// Unary calls whose message does not come as it should.
#include "server/unary_call.hpp"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include "server/running_server.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;

/// A call of InsertScan, byte by byte.
class RawCall {
 public:
  explicit RawCall(const std::string& address)
      : stub_(grpc::CreateChannel(address, grpc::InsecureChannelCredentials())),
        call_(stub_.PrepareCall(&context_, "/nbvopt.v1.Planner/InsertScan", &queue_)) {
    call_->StartCall(nullptr);
    step();
  }

  void write(const std::string& bytes) {
    const grpc::Slice slice(bytes);
    call_->Write(grpc::ByteBuffer(&slice, 1), nullptr);
    step();
  }

  void writes_done() {
    call_->WritesDone(nullptr);
    step();
  }

  grpc::Status finish() {
    grpc::Status status;
    call_->Finish(&status, nullptr);
    step();
    return status;
  }

 private:
  void step() {
    void* tag = nullptr;
    bool ok = false;
    queue_.Next(&tag, &ok);
  }

  grpc::CompletionQueue queue_;
  grpc::ClientContext context_;
  grpc::GenericStub stub_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> call_;
};

class UnaryCalls : public ::testing::Test {
 protected:
  std::uint64_t failed_scans() const {
    const auto stub = running.stub();
    grpc::ClientContext context;
    v1::GetStatusReply reply;
    EXPECT_TRUE(stub->GetStatus(&context, {}, &reply).ok());
    EXPECT_EQ(reply.latencies(3).method(), "InsertScan");
    return reply.latencies(3).failed();
  }

  test::RunningServer running{{.max_receive_s = 0.3}};
};

TEST_F(UnaryCalls, EndWhenTheirMessageDoesNotCome) {
  RawCall call(running.server.address());
  const grpc::Status status = call.finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_THAT(status.error_message(), HasSubstr("took too long"));
  EXPECT_EQ(failed_scans(), 1U);
}

TEST_F(UnaryCalls, SayThatThereIsNoMessage) {
  RawCall call(running.server.address());
  call.writes_done();
  EXPECT_EQ(call.finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(failed_scans(), 1U);
}

TEST_F(UnaryCalls, SayThatTheMessageIsNone) {
  RawCall call(running.server.address());
  call.write("\xFF\xFF\xFF");
  EXPECT_EQ(call.finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(failed_scans(), 1U);
}

}  // namespace
}  // namespace nbvopt
