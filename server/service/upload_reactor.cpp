#include "service/upload_reactor.h"

#include <fmt/format.h>

#include "service/status.h"

namespace sundial {

using Clock = std::chrono::steady_clock;

namespace {
constexpr std::size_t kMaxFiles = 10'000;
constexpr int kRetryMs = 1000;
}  // namespace

UploadReactor* UploadReactor::start(CallContext& context, grpc::CallbackServerContext* call,
                                    v1::SceneInfo* answer) {
  auto reactor = std::make_shared<UploadReactor>(context, call, answer);
  reactor->self_ = reactor;
  {
    const std::lock_guard lock(reactor->mutex_);
    reactor->lastRead_ = Clock::now();
    reactor->arm(reactor->lastRead_ + context.limits.stallTimeout);
  }
  reactor->StartRead(&reactor->part_);
  return reactor.get();
}

UploadReactor::UploadReactor(CallContext& context, grpc::CallbackServerContext* call, v1::SceneInfo* answer)
    : context_(context), call_(call), answer_(answer), log_(context, *call, "UploadScene") {
  context_.calls.begin();
}

UploadReactor::~UploadReactor() { context_.uploadBytes -= bytes_; }

void UploadReactor::OnReadDone(bool ok) {
  Result<void> taken;
  {
    const std::lock_guard lock(mutex_);
    if (status_) return;
    lastRead_ = Clock::now();
    reading_ = ok;
    if (ok) taken = take();
  }
  if (!ok) return load();
  if (!taken) return end(toStatus(taken.error()));
  StartRead(&part_);
}

Result<void> UploadReactor::take() {
  switch (part_.part_case()) {
    case v1::UploadSceneRequest::kMain:
      if (!files_.main.empty()) return invalid("main is given twice: give it once, first");
      if (part_.main().empty() || part_.main().size() > kMaxNameLength) {
        return invalid(
            fmt::format("main has {} bytes: must have 1 to {}", part_.main().size(), kMaxNameLength));
      }
      files_.main = part_.main();
      log_.record.subject = files_.main;
      return {};
    case v1::UploadSceneRequest::kFile: {
      if (files_.main.empty()) return invalid("file comes before main: give main first");
      if (part_.file().empty() || part_.file().size() > kMaxNameLength) {
        return invalid(
            fmt::format("file has {} bytes: must have 1 to {}", part_.file().size(), kMaxNameLength));
      }
      if (files_.files.size() >= kMaxFiles) {
        return fail(ErrorCode::resourceExhausted,
                    fmt::format("more than {} files: pack the scene into a .glb", kMaxFiles));
      }
      const auto [it, added] = files_.files.try_emplace(part_.file());
      if (!added) return invalid(fmt::format("file '{}' is given twice: give each file once", part_.file()));
      file_ = &it->second;
      return {};
    }
    case v1::UploadSceneRequest::kChunk:
      return takeChunk();
    case v1::UploadSceneRequest::PART_NOT_SET:
      break;
  }
  return invalid("part isn't set: give main, file or chunk");
}

Result<void> UploadReactor::takeChunk() {
  const std::string& chunk = part_.chunk();
  if (!file_) return invalid("chunk comes before file: begin a file first");
  if (chunk.size() > kChunkBytes) {
    return invalid(fmt::format("chunk has {} bytes: must have at most {}", chunk.size(), kChunkBytes));
  }
  const std::uint64_t limit = context_.limits.uploadBytes;
  bytes_ += chunk.size();
  const std::uint64_t all = context_.uploadBytes += chunk.size();
  if (bytes_ > limit) {
    return fail(
        ErrorCode::resourceExhausted,
        fmt::format("the upload is larger than this server's {} bytes: send less, or start it with a larger "
                    "--max-upload-mib",
                    limit));
  }
  if (all > limit) {
    call_->AddTrailingMetadata(kRetryKey, fmt::format("{}", kRetryMs));
    return fail(
        ErrorCode::resourceExhausted,
        fmt::format("uploads in flight are more than this server's {} bytes: try again later", limit));
  }
  try {
    file_->append(chunk);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::resourceExhausted, "the upload needs more memory than the server has: send less");
  }
  return {};
}

// The client has sent all, or has gone: then the call is cancelled, and the store keeps nothing.
void UploadReactor::load() {
  if (call_->IsCancelled()) return end({grpc::StatusCode::CANCELLED, "the client went away"});
  SceneFiles files;
  {
    const std::lock_guard lock(mutex_);
    files = std::move(files_);
  }
  if (!files.files.contains(files.main)) {
    return end(toStatus(
        {ErrorCode::invalidArgument,
         fmt::format("main is '{}', which is not among the {} files sent", files.main, files.files.size())}));
  }
  context_.store.upload(
      std::move(files), stop_.get_token(),
      [self = shared_from_this()](Result<LoadedScene> loaded) { self->onScene(std::move(loaded)); });
}

void UploadReactor::onScene(Result<LoadedScene> loaded) {
  if (!loaded) return end(toStatus(loaded.error()));
  {
    const std::lock_guard lock(mutex_);
    if (status_) return;  // gRPC has the answer, or is done with it
    toProto(*loaded, answer_);
  }
  end(grpc::Status::OK);
}

void UploadReactor::end(const grpc::Status& status) {
  {
    const std::lock_guard lock(mutex_);
    if (status_) return;
    status_ = status;
  }
  Finish(status);
}

void UploadReactor::OnCancel() {
  stop_.request_stop();
  end({grpc::StatusCode::CANCELLED, "the client went away or its deadline passed"});
}

void UploadReactor::OnDone() {
  {
    const std::lock_guard lock(mutex_);
    if (alarm_) context_.timer.forget(*alarm_);
    alarm_.reset();
    log_.end(*status_);
  }
  CallContext& context = context_;
  self_.reset();
  context.calls.end();
}

void UploadReactor::arm(Clock::time_point time) {
  alarm_ = context_.timer.at(time, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->onTime();
  });
}

void UploadReactor::onTime() {
  {
    const std::lock_guard lock(mutex_);
    if (status_ || !reading_) return;
    if (const auto due = lastRead_ + context_.limits.stallTimeout; due > Clock::now()) return arm(due);
  }
  stop_.request_stop();
  end({grpc::StatusCode::DEADLINE_EXCEEDED,
       fmt::format("the upload made no progress for {} ms: send it again",
                   context_.limits.stallTimeout.count())});
}

}  // namespace sundial
