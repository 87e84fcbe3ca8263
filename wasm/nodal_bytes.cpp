#include "nodal_bytes.h"

#include <cstdint>
#include <cstring>

#include "pillowmesh/metric/discrete.h"
#include "pillowmesh/metric/spectrum.h"

namespace pillowmesh {
namespace {

constexpr std::size_t kHead = 4 * sizeof(std::int32_t);

template <class T>
void append(const std::vector<T>& values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}
template <class T>
void take(const char*& from, std::vector<T>& values, std::size_t count) {
  values.resize(count);
  std::memcpy(static_cast<void*>(values.data()), from, count * sizeof(T));
  from += count * sizeof(T);
}

}  // namespace

template <int Dim>
std::string nodal_to_bytes(const NodalMetric<Dim>& metric) {
  std::vector<SymTensor<Dim>> logs;
  logs.reserve(metric.tensors.size());
  for (const SymTensor<Dim>& M : metric.tensors) logs.push_back(log_tensor(M));
  std::string bytes;
  append<std::int32_t>(
      {Dim, static_cast<std::int32_t>(metric.points.size()), static_cast<std::int32_t>(metric.simplices.size()), 0},
      bytes);
  append(metric.points, bytes);
  append(logs, bytes);
  append(metric.simplices, bytes);
  return bytes;
}

template <int Dim>
Expected<MetricField<Dim>> field_from_bytes(std::span<const char> bytes) {
  std::int32_t head[4] = {};
  if (bytes.size() >= kHead) std::memcpy(head, bytes.data(), kHead);
  const auto points = static_cast<std::uint32_t>(head[1]), simplices = static_cast<std::uint32_t>(head[2]);
  const std::uint64_t size = kHead + points * std::uint64_t{sizeof(Point<Dim>) + sizeof(SymTensor<Dim>)} +
                             simplices * std::uint64_t{sizeof(Simplex<Dim>)};
  if (head[0] != Dim || size != bytes.size())
    return Status::usage("These are not the bytes of a metric of the mesh's dimension.");
  const char* from = bytes.data() + kHead;
  std::vector<Point<Dim>> p;
  std::vector<SymTensor<Dim>> logs;
  std::vector<Simplex<Dim>> s;
  take(from, p, points);
  take(from, logs, points);
  take(from, s, simplices);
  auto metric = DiscreteMetric<Dim>::make(std::move(p), std::move(s), std::move(logs));
  if (!metric) return metric.status();
  return MetricField<Dim>::discrete(std::move(*metric));
}

template std::string nodal_to_bytes(const NodalMetric<2>&);
template std::string nodal_to_bytes(const NodalMetric<3>&);
template Expected<MetricField<2>> field_from_bytes(std::span<const char>);
template Expected<MetricField<3>> field_from_bytes(std::span<const char>);

}  // namespace pillowmesh
