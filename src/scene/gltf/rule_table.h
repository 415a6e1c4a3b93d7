// The rules that a glTF document is checked by.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace penumbra::gltf {

enum class Kind {
  object,
  list,  ///< array of objects
  text,
  flag,
  number,
  not_negative,  ///< number ≥ 0
  positive,      ///< number > 0
  numbers,       ///< array of `length` numbers
  color,         ///< array of three numbers ≥ 0
  count,         ///< whole number ≥ 0
  int_count,     ///< the same, below 2^31: tinygltf keeps it in an int
  stride,        ///< whole number, multiple of 4, 4 to 252
  index,         ///< into the array that `argument` is the path of
  indices,       ///< array of such
  word_of,       ///< one of the words in `argument`, separated by |
  number_of      ///< one of the whole numbers in `argument`, separated by |
};

/// `path`: steps separated by dots; "name[]" stands for every element of an array, "*" for every
/// member of an object. What is absent is fine unless `required`, which asks for the last step
/// where the others are there.
struct Rule {
  std::string path;
  Kind kind;
  std::string argument{};
  std::size_t length = 0;
  bool required = false;
};

/// Of asset, extensionsUsed and extensionsRequired.
std::span<const Rule> declaration_rules();

/// Of all the rest: glTF 2.0, section 5, and the extensions that are implemented.
std::span<const Rule> document_rules();

}  // namespace penumbra::gltf
