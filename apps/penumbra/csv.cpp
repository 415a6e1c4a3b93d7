#include "csv.h"

#include <fmt/format.h>

#include "base/error.h"

namespace penumbra::app {
namespace {

class Reader {
 public:
  Reader(const std::string& text, const std::string& file) : text_(text), file_(file) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_begin_ = 3;
  }

  bool at_end() const { return at_ == text_.size(); }
  CsvRow row();
  const std::string& line_end() const { return line_end_; }

 private:
  CsvField field();
  void quoted(CsvField& field);
  void end_line();
  bool at_line_end() const { return at_end() || text_[at_] == '\n' || is_crlf(); }
  bool is_crlf() const { return text_.compare(at_, 2, "\r\n") == 0; }
  [[noreturn]] void refuse(const CsvField& field, const char* what) const {
    throw InputError({file_, field.line, field.column}, what,
                     "write quotes inside a quoted field twice and close it");
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0, line_begin_ = 0;
  std::uint64_t line_ = 1;
  std::string line_end_ = "\n";
};

void Reader::quoted(CsvField& field) {
  for (++at_;; ++at_) {
    if (at_end()) refuse(field, "this quoted field does not end");
    if (text_[at_] == '\n') ++line_, line_begin_ = at_ + 1;
    if (text_[at_] == '"' && text_[++at_] != '"') break;
    field.value += text_[at_];
  }
  if (!at_line_end() && text_[at_] != ',') refuse(field, "text follows a quoted field");
}

CsvField Reader::field() {
  CsvField field{{}, {}, line_, at_ - line_begin_ + 1};
  const std::size_t begin = at_;
  if (!at_end() && text_[at_] == '"') {
    quoted(field);
  } else {
    while (!at_line_end() && text_[at_] != ',') ++at_;
    field.value = text_.substr(begin, at_ - begin);
    if (field.value.find('"') != std::string::npos)
      refuse(field, "a quote stands in the middle of a field");
  }
  field.raw = text_.substr(begin, at_ - begin);
  return field;
}

void Reader::end_line() {
  line_end_ = is_crlf() ? "\r\n" : "\n";
  at_ = std::min(at_ + line_end_.size(), text_.size());
  line_begin_ = at_;
  ++line_;
}

CsvRow Reader::row() {
  CsvRow row{field()};
  while (!at_line_end()) {
    ++at_;
    row.push_back(field());
  }
  end_line();
  return row;
}

bool is_blank(const CsvRow& row) {
  return row.size() == 1 && row[0].raw.find_first_not_of(" \t\r") == std::string::npos;
}

}  // namespace

CsvTable parse_csv(const std::string& text, const std::string& file) {
  Reader reader(text, file);
  CsvTable table;
  if (!reader.at_end()) table.header = reader.row();
  table.line_end = reader.line_end();
  if (table.header.empty() || is_blank(table.header))
    throw InputError({file, 1, 1}, "there is no header", "begin with the line x,y,z,nx,ny,nz");
  while (!reader.at_end()) {
    CsvRow row = reader.row();
    if (is_blank(row)) continue;
    if (row.size() != table.header.size())
      throw InputError({file, row[0].line, row[0].column},
                       fmt::format("this row has {} fields and the header has {}", row.size(),
                                   table.header.size()),
                       "give every row a value for each column");
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string to_text(const CsvTable& table) {
  std::string text;
  const auto add = [&](const CsvRow& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ',';
      text += row[i].raw;
    }
    text += table.line_end;
  };
  add(table.header);
  for (const CsvRow& row : table.rows) add(row);
  return text;
}

}  // namespace penumbra::app
