// C files as OpenEXR's streams, which remember a failed write (OpenEXR's own destructors forget
// it).
#pragma once

#include <ImfIO.h>

#include <cstdio>
#include <string>

namespace penumbra {

/// Writes to a file that must be open for as long as this lives.
class ExrOutput : public Imf::OStream {
 public:
  ExrOutput(std::FILE* file, const std::string& name) : OStream(name.c_str()), file_(file) {}
  void write(const char* bytes, int count) override;
  std::uint64_t tellp() override;
  void seekp(std::uint64_t position) override;
  /// False if any write so far failed.
  bool flush();

 private:
  std::FILE* file_;
  bool failed_ = false;
};

/// Reads from memory that must outlive this.
class ExrInput : public Imf::IStream {
 public:
  ExrInput(const std::string& bytes, const std::string& name)
      : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* out, int count) override;
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::string& bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace penumbra
