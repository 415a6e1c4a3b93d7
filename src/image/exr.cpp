#include "image/exr.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "image/exr_stream.h"

namespace penumbra {
namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

std::string full_name(const ExrLayer& layer, std::size_t channel) {
  const std::string& name = layer.channels[channel];
  return layer.name.empty() ? name : layer.name + '.' + name;
}

// OpenEXR wants floats and halves laid out before it writes; halves need a copy.
std::vector<half> halves_of(const Image& image) {
  std::vector<half> out(image.data.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = half(image.data[i]);
  return out;
}

template <class T>
void insert_slices(Imf::FrameBuffer& buffer, const ExrLayer& layer, const T* data,
                   Imf::PixelType type) {
  const std::size_t stride = sizeof(T) * layer.image->channels;
  for (std::size_t k = 0; k < layer.channels.size(); ++k) {
    // The library's interface is not const, though writing does not change the pixels.
    char* base = reinterpret_cast<char*>(const_cast<T*>(data + k));
    buffer.insert(full_name(layer, k), Imf::Slice(type, base, stride, stride * layer.image->width));
  }
}

Imf::Header header_of(const std::vector<ExrLayer>& layers, const ExrAttributes& attributes) {
  const Image& first = *layers.front().image;
  Imf::Header header(first.width, first.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 2;
  for (const ExrLayer& layer : layers)
    for (std::size_t k = 0; k < layer.channels.size(); ++k)
      header.channels().insert(full_name(layer, k),
                               Imf::Channel(layer.half_precision ? Imf::HALF : Imf::FLOAT));
  for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
  return header;
}

void write_pixels(ExrOutput& stream, const std::vector<ExrLayer>& layers,
                  const ExrAttributes& attributes) {
  std::vector<std::vector<half>> copies;
  Imf::FrameBuffer buffer;
  for (const ExrLayer& layer : layers) {
    if (layer.half_precision)
      insert_slices(buffer, layer, copies.emplace_back(halves_of(*layer.image)).data(), Imf::HALF);
    else
      insert_slices(buffer, layer, layer.image->data.data(), Imf::FLOAT);
  }
  Imf::setGlobalThreadCount(thread_count());
  const Imf::Header header = header_of(layers, attributes);
  Imf::OutputFile file(stream, header, thread_count());
  file.setFrameBuffer(buffer);
  file.writePixels(header.dataWindow().max.y + 1);
}

// A header alone must not make us allocate more than its file can hold: ZIP and RLE expand a byte
// to at most 1032.
Image sized_channel(const Imf::Header& header, std::size_t file_size) {
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width <= 0 || height <= 0 || width > 65536 || height > 65536 ||
      static_cast<std::uint64_t>(width * height) / 1032 > file_size)
    throw Iex::InputExc("the size in its header is not that of its contents");
  return {static_cast<int>(width), static_cast<int>(height), 1};
}

void read_pixels(Imf::InputFile& file, std::size_t file_size, ExrFile& out) {
  const Imf::Header& header = file.header();
  const Imath::Box2i& window = header.dataWindow();
  const Image blank = sized_channel(header, file_size);
  const std::size_t row = sizeof(float) * blank.width;
  Imf::FrameBuffer buffer;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw Iex::InputExc("a channel is subsampled");
    Image& image = out.channels[channel.name()] = blank;
    // Where pixel (0, 0) would lie: computed as a number, because it may be outside the image.
    const auto origin = reinterpret_cast<std::intptr_t>(image.data.data()) -
                        window.min.x * static_cast<std::intptr_t>(sizeof(float)) -
                        window.min.y * static_cast<std::intptr_t>(row);
    buffer.insert(channel.name(),
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(origin), sizeof(float), row));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
}

}  // namespace

void write_exr(const std::string& path, const std::vector<ExrLayer>& layers,
               const ExrAttributes& attributes) {
  AtomicFile target(path);
  std::unique_ptr<std::FILE, CloseFile> file(std::fopen(target.temporary_path().c_str(), "wb"));
  const auto fail = [&](const std::string& reason) {
    return WorkError({path}, "cannot be written (" + reason + ")",
                     "free some space or choose another output");
  };
  if (!file) throw fail(std::strerror(errno));
  try {
    ExrOutput stream(file.get(), path);
    write_pixels(stream, layers, attributes);
    if (!stream.flush()) throw fail(std::strerror(errno));
  } catch (const Iex::BaseExc& error) {
    throw fail(error.what());
  }
  file.reset();
  target.commit();
}

ExrFile read_exr(const std::string& path) {
  const std::string bytes = read_file(path);
  ExrFile out;
  try {
    Imf::Header::setMaxImageSize(65536, 65536);
    ExrInput stream(bytes, path);
    Imf::InputFile file(stream, 0);
    const Imf::Header& header = file.header();
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
        out.attributes[attribute.name()] = text->value();
    read_pixels(file, bytes.size(), out);
  } catch (const std::exception& error) {
    throw InputError({path}, std::string("cannot be read as OpenEXR (") + error.what() + ")",
                     "check how it was made");
  }
  return out;
}

}  // namespace penumbra
