#include <cmath>
#include <string_view>

#include "pillowmesh/mesh/number.h"
#include "pillowmesh/quality/report.h"

namespace pillowmesh {
namespace {

// Appends JSON, two spaces per level. The schema is fixed and flat, so a writer of two levels is all it takes.
class JsonWriter {
 public:
  void open(std::string_view key) {
    begin(key);
    text_ += '{';
    first_ = true;
    ++level_;
  }
  void close() {
    --level_;
    if (!first_) new_line();
    text_ += '}';
    first_ = false;
  }
  void number(std::string_view key, double value) {
    begin(key);
    text_ += std::isfinite(value) ? number_text(value) : "null";
  }
  void integer(std::string_view key, std::int64_t value) {
    begin(key);
    text_ += std::to_string(value);
  }
  void boolean(std::string_view key, bool value) {
    begin(key);
    text_ += value ? "true" : "false";
  }
  void string(std::string_view key, std::string_view value) {
    begin(key);
    quote(value);
  }
  std::string take() { return std::move(text_); }

 private:
  void begin(std::string_view key) {
    if (level_ == 0) return;
    if (!first_) text_ += ',';
    first_ = false;
    new_line();
    quote(key);
    text_ += ": ";
  }
  void new_line() { text_.append(1, '\n').append(static_cast<std::size_t>(2 * level_), ' '); }
  void quote(std::string_view value) {
    constexpr char kHex[] = "0123456789abcdef";
    text_ += '"';
    for (const char c : value) {
      if (c == '"' || c == '\\') {
        text_.append(1, '\\').append(1, c);
      } else if (static_cast<unsigned char>(c) < 0x20) {
        text_.append("\\u00").append(1, kHex[c >> 4]).append(1, kHex[c & 15]);
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }

  std::string text_;
  int level_ = 0;
  bool first_ = true;
};

void write(JsonWriter& json, std::string_view key, const Statistics& s, bool with_share) {
  json.open(key);
  json.integer("count", s.count);
  json.number("min", s.min);
  json.number("mean", s.mean);
  json.number("max", s.max);
  json.number("cv", s.cv);
  if (with_share) json.number("share_in_range", s.share_in_range);
  json.close();
}

}  // namespace

std::string to_json(const Report& report) {
  JsonWriter json;
  json.open("");
  json.open("mesh");
  json.integer("dim", report.dim);
  json.integer("vertices", report.vertices);
  json.integer("edges", report.edges);
  json.integer("cells", report.cells);
  json.close();
  write(json, "edge_length", report.edge_length, true);
  write(json, "shape", report.shape, false);
  write(json, "shape_integral", report.shape_integral, false);
  json.open("scaled_jacobian");
  json.number("min", report.scaled_jacobian_min);
  json.number("mean", report.scaled_jacobian_mean);
  json.close();
  json.integer("irregular_vertices", report.irregular_vertices);
  if (report.dim == 2) json.number("misalignment", report.misalignment);
  json.number("complexity", report.complexity);
  json.boolean("valid", report.valid);
  if (!report.valid) json.string("defect", report.defect);
  if (!report.fields.empty()) {
    json.open("fields");
    for (const bool of_cells : {false, true}) {
      json.open(of_cells ? "cells" : "points");
      for (const CarriedField& f : report.fields)
        if (f.of_cells == of_cells) json.string(f.name, f.how);
      json.close();
    }
    json.close();
  }
  json.open("seconds");
  for (const auto& [name, value] : report.seconds) json.number(name, value);
  json.close();
  json.integer("peak_memory_bytes", report.peak_memory_bytes);
  json.open("operations");
  for (const auto& [name, value] : report.operations) json.integer(name, value);
  json.close();
  json.close();
  return json.take();
}

}  // namespace pillowmesh
