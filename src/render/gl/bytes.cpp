#include "render/gl/bytes.h"

namespace penumbra {
namespace {

// Writes values to bytes or reads them from bytes: one list of fields serves both.
class Writer {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  template <class T>
  void values(const T& v) {
    value(v.size());
    bytes.append(reinterpret_cast<const char*>(v.data()), v.size() * sizeof v[0]);
  }
  template <class T, class Each>
  void list(const std::vector<T>& all, Each each) {
    value(all.size());
    for (const T& one : all) each(one);
  }

  std::string bytes;
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  void value(T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    take(&v, sizeof v);
  }
  template <class T>
  void values(T& v) {
    std::size_t size = 0;
    value(size);
    v.resize(size);
    take(v.data(), size * sizeof v[0]);
  }
  template <class T, class Each>
  void list(std::vector<T>& all, Each each) {
    std::size_t size = 0;
    value(size);
    all.resize(size);
    for (T& one : all) each(one);
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

template <class Stream, class I>
void image(Stream& s, I& i) {
  s.value(i.width), s.value(i.height), s.value(i.channels);
  s.values(i.data);
}

template <class Stream, class R>
void result(Stream& s, R& r) {
  image(s, r.color), image(s, r.depth), image(s, r.normal), image(s, r.error), image(s, r.steps);
  s.list(r.visibility, [&](auto& i) { image(s, i); });
  s.list(r.warnings, [&](auto& text) { s.values(text); });
  auto& stats = r.stats;
  s.value(stats.seconds_build), s.value(stats.seconds_render), s.value(stats.exposure_ev),
      s.value(stats.ambient);
  s.value(stats.field_steps), s.value(stats.unfinished), s.value(stats.primary_rays);
  s.values(stats.device);
}

template <class Stream, class A>
void answers(Stream& s, A& a) {
  s.values(a.fractions), s.values(a.device);
  s.value(a.field_steps), s.value(a.unfinished);
}

}  // namespace

std::string to_bytes(const RenderResult& r) {
  Writer writer;
  result(writer, r);
  return std::move(writer.bytes);
}

std::string to_bytes(const ProbeAnswers& a) {
  Writer writer;
  answers(writer, a);
  return std::move(writer.bytes);
}

RenderResult render_result_from(const std::string& bytes) {
  Reader reader(bytes);
  RenderResult r;
  result(reader, r);
  return r;
}

ProbeAnswers probe_answers_from(const std::string& bytes) {
  Reader reader(bytes);
  ProbeAnswers a;
  answers(reader, a);
  return a;
}

}  // namespace penumbra
