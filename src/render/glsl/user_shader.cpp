#include "render/glsl/user_shader.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "base/error.h"

namespace penumbra {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// A word, or one other character that is not blank.
struct Token {
  std::string_view text;
  std::size_t at = 0;
  int line = 1;
  bool first_in_line = false;
};

void blank(std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i)
    if (text[i] != '\n') text[i] = ' ';
}

std::string without_comments(std::string text) {
  for (std::size_t i = 0; i + 1 < text.size();) {
    const bool line = text[i] == '/' && text[i + 1] == '/';
    const bool block = text[i] == '/' && text[i + 1] == '*';
    if (!line && !block) {
      ++i;
      continue;
    }
    const std::size_t end = line ? text.find('\n', i) : text.find("*/", i + 2);
    const std::size_t next = end == text.npos ? text.size() : end + (line ? 0 : 2);
    blank(text, i, next);
    i = next;
  }
  return text;
}

std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  int line = 1;
  bool first = true;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') ++line, first = true;
    if (is_blank(text[i])) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    if (is_word(text[i]))
      while (end < text.size() && is_word(text[end])) ++end;
    tokens.push_back({std::string_view(text).substr(i, end - i), i, line, first});
    first = false;
    i = end;
  }
  return tokens;
}

// Do these texts stand one after the other from token i?
bool follow(const std::vector<Token>& tokens, std::size_t i,
            std::initializer_list<std::string_view> texts) {
  if (i + texts.size() > tokens.size()) return false;
  return std::equal(texts.begin(), texts.end(), tokens.begin() + static_cast<std::ptrdiff_t>(i),
                    [](std::string_view a, const Token& b) { return a == b.text; });
}

bool anywhere(const std::vector<Token>& tokens, std::initializer_list<std::string_view> texts) {
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (follow(tokens, i, texts)) return true;
  return false;
}

bool is_our_uniform(std::string_view name) {
  constexpr std::array<std::string_view, 11> names{
      "iResolution", "iTime",     "iTimeDelta", "iFrame",    "iFrameRate", "iMouse",
      "iDate",       "iChannel0", "iChannel1",  "iChannel2", "iChannel3"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_directive(const std::vector<Token>& tokens, std::size_t i, std::string_view name) {
  return tokens[i].first_in_line && follow(tokens, i, {"#", name});
}

// uniform [precision] type NAME ;
std::size_t end_of_our_uniform(const std::vector<Token>& tokens, std::size_t i) {
  if (tokens[i].text != "uniform") return 0;
  for (const std::size_t name : {i + 2, i + 3})
    if (name + 1 < tokens.size() && is_our_uniform(tokens[name].text) &&
        tokens[name + 1].text == ";")
      return tokens[name + 1].at + 1;
  return 0;
}

void blank_what_is_ours(std::string& code) {
  const std::string copy = code;
  const std::vector<Token> tokens = tokens_of(copy);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (is_directive(tokens, i, "version"))
      blank(code, tokens[i].at, std::min(code.find('\n', tokens[i].at), code.size()));
    if (const std::size_t end = end_of_our_uniform(tokens, i)) blank(code, tokens[i].at, end);
  }
}

std::string renamed(std::string_view word) {
  if (word == "gl_FragCoord") return "pnb_FragCoord";
  if (word == "main" || word.starts_with("pnb_") || word.starts_with("penumbra_"))
    return "user_" + std::string(word);
  return std::string(word);
}

std::string with_names_changed(const std::string& code) {
  std::string result;
  std::size_t done = 0;
  for (const Token& token : tokens_of(code)) {
    result.append(code, done, token.at - done);
    result += renamed(token.text);
    done = token.at + token.text.size();
  }
  return result.append(code, done);
}

void find_names(const std::vector<Token>& tokens, UserShader& shader) {
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i)
    if (is_directive(tokens, i, "define")) shader.macros.emplace_back(tokens[i + 2].text);
  for (const char* channel : {"iChannel0", "iChannel1", "iChannel2", "iChannel3"})
    if (anywhere(tokens, {channel})) shader.channels.emplace_back(channel);
  shader.has_map = anywhere(tokens, {"float", "map", "("});
  shader.has_albedo = anywhere(tokens, {"vec3", "albedo", "("});
  shader.has_main_image = anywhere(tokens, {"void", "mainImage", "("});
}

void check(const std::vector<Token>& tokens, const UserShader& shader) {
  if (shader.has_map || shader.has_main_image) return;
  for (std::size_t i = 1; i < tokens.size(); ++i)
    if (follow(tokens, i, {"map", "("}) && tokens[i - 1].text.starts_with("vec"))
      throw InputError({shader.file, tokens[i].line},
                       "map returns " + std::string(tokens[i - 1].text),
                       "let it be float map(vec3 p), the distance from p to the scene");
  throw InputError({shader.file}, "the shader has neither map nor mainImage",
                   "give it a float map(vec3 p), the distance from p to the scene");
}

}  // namespace

UserShader read_user_shader(const std::string& file, const std::string& text) {
  UserShader shader;
  shader.file = file;
  std::string code = without_comments(text);
  blank_what_is_ours(code);
  shader.code = with_names_changed(code);
  const std::vector<Token> tokens = tokens_of(shader.code);
  find_names(tokens, shader);
  check(tokens, shader);
  return shader;
}

std::string without_macros(const UserShader& shader) {
  std::string text;
  for (const std::string& macro : shader.macros)
    if (macro != "map" && macro != "albedo" && macro != "mainImage")
      text += "#undef " + macro + '\n';
  return text;
}

}  // namespace penumbra
