// Ratios within one run; machines differ and are noisy. Every rate is per second of wall time with the threads named.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <experimental/simd>
#include <map>

#include "cases/driver/prepared.hpp"
#include "plate/bonds/preconditioners.hpp"
#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/statics.hpp"

namespace {

using plate::State;

/// The plate of Dai et al. 4.1, W/2h = 10, 2a/W = 0.1, with `cells` along a side.
struct Plate {
  cases::CaseFile file;
  std::unique_ptr<plate::Formulation> formulation;
  State state, forces;
  plate::Forces load;

  const plate::LatticeOperator& op() const {
    return dynamic_cast<const plate::LatticeOperator&>(*formulation->breaking());
  }
  const plate::Boundary& boundary() const { return formulation->boundary(); }
  double bonds() const { return double(op().families().bonds()); }
};

Plate& plate_of(std::int64_t cells) {
  static std::map<std::int64_t, std::unique_ptr<Plate>> known;
  auto& entry = known[cells];
  if (!entry) {
    const auto file = cases::read_case(std::string(PDPLATE_SOURCE_DIR) + "/cases/static/central_crack_pressure.toml",
                                       {"geometry.cracks=[[[-0.1, 0.0], [0.1, 0.0]]]",
                                        "discretization.spacing=" + std::to_string(2.0 / double(cells))});
    auto formulation = cases::discretised(file).plate;
    const auto points = Eigen::Index(formulation->points());
    auto load = formulation->loads().front().forces;
    entry.reset(
        new Plate{file, std::move(formulation), State::Random(3, points), State::Zero(3, points), std::move(load)});
  }
  return *entry;
}

void rate(benchmark::State& run, const char* name, double each) {
  run.counters[name] = benchmark::Counter(each, benchmark::Counter::kIsIterationInvariantRate);
}

/// As peers do it: a list of neighbours, the geometry of every bond computed when it is met, constant parameters.
void list_with_geometry_on_the_fly(benchmark::State& run) {
  omp_set_num_threads(1);
  Plate& p = plate_of(run.range(0));
  const auto& families = p.op().families();
  const auto& x = p.boundary().cloud.positions;
  const double delta = p.file.content.discretization.horizon(), area = p.boundary().cloud.areas.front();
  const auto points = families.points();
  std::vector<std::uint32_t> neighbour;
  std::vector<std::size_t> first{0};
  for (std::size_t k = 0; k < points; ++k) {
    for (const auto& bond : families[k]) neighbour.push_back(bond.neighbour);
    first.push_back(neighbour.size());
  }
  std::vector<double> dilatation(points);
  for (auto _ : run) {
    for (std::size_t k = 0; k < points; ++k) {
      double sum = 0;
      for (auto b = first[k]; b < first[k + 1]; ++b) {
        const auto j = neighbour[b];
        const geometry::Point xi = x[j] - x[k];
        const double length = xi.norm(), mx = xi.y() / length, my = -xi.x() / length;
        sum += delta / length * area * (mx * (p.state(1, j) - p.state(1, k)) + my * (p.state(2, j) - p.state(2, k)));
      }
      dilatation[k] = sum;
    }
    for (std::size_t k = 0; k < points; ++k) {
      double force = 0, couple_x = 0, couple_y = 0;
      for (auto b = first[k]; b < first[k + 1]; ++b) {
        const auto j = neighbour[b];
        const geometry::Point xi = x[j] - x[k];
        const double length = xi.norm(), mx = xi.y() / length, my = -xi.x() / length, weight = delta / length * area;
        const double bend = mx * (p.state(1, j) - p.state(1, k)) + my * (p.state(2, j) - p.state(2, k));
        const double turn = mx * (p.state(1, j) + p.state(1, k)) + my * (p.state(2, j) + p.state(2, k));
        const double shear = weight * (p.state(0, j) - p.state(0, k) - length / 2 * turn);
        const double couple = weight * (dilatation[k] + dilatation[j]) + weight / length * bend + shear * length / 2;
        force += shear, couple_x += mx * couple, couple_y += my * couple;
      }
      p.forces.col(Eigen::Index(k)) << force, couple_x, couple_y;
    }
    benchmark::DoNotOptimize(p.forces.data());
  }
  rate(run, "bonds", p.bonds());
}

void family_list(benchmark::State& run) {
  omp_set_num_threads(int(run.range(1)));
  Plate& p = plate_of(run.range(0));
  const plate::FamilyOperator list = p.op();
  for (auto _ : run) list.internal_force(p.state, p.forces);
  rate(run, "bonds", p.bonds());
}

void lattice_operator(benchmark::State& run) {
  omp_set_num_threads(int(run.range(1)));
  Plate& p = plate_of(run.range(0));
  for (auto _ : run) p.op().internal_force(p.state, p.forces);
  rate(run, "bonds", p.bonds());
  rate(run, "points", double(p.op().points()));
  // per point of a folded row with 28 bonds: 34 and 150 operations of a vector unit on as many points as it has lanes
  rate(run, "vector_operations", p.bonds() * 184 / 28 / double(std::experimental::native_simd<double>::size()));
}

void single_precision(benchmark::State& run) {
  omp_set_num_threads(int(run.range(1)));
  Plate& p = plate_of(run.range(0));
  const auto rows = p.op().single_rows();
  const plate::Values<float> state = p.state.cast<float>();
  plate::Values<float> forces;
  for (auto _ : run) rows.internal_force(state, forces);
  rate(run, "bonds", p.bonds());
}

/// Multiply-adds of one core that wait for nothing.
void peak_arithmetic(benchmark::State& run) {
  using Lane = std::experimental::native_simd<double>;
  Lane sums[12];
  for (auto& sum : sums) sum = 1;
  const Lane factor = 0.999999, term = 1e-7;
  for (auto _ : run) {
    for (int i = 0; i < 1000; ++i)
#pragma GCC unroll 12
      for (auto& sum : sums) sum = sum * factor + term;
    for (auto& sum : sums) benchmark::DoNotOptimize(sum);
  }
  rate(run, "vector_operations", 12 * 1000);
}

void triad(benchmark::State& run) {
  omp_set_num_threads(int(run.range(0)));
  const std::size_t size = 20'000'000;
  std::vector<double> a(size, 1), b(size, 2), c(size, 3);
  for (auto _ : run) {
#pragma omp parallel for simd schedule(static)
    for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + 3 * c[i];
    benchmark::DoNotOptimize(a.data());
  }
  rate(run, "bytes", 24.0 * double(size));
}

enum class Way { adr, diagonal, local, two_level, direct };

template <Way way>
void statics(benchmark::State& run) {
  omp_set_num_threads(2);
  Plate& p = plate_of(run.range(0));
  const auto& c = p.file.content;
  const auto& constraints = p.boundary().constraints;
  const plate::StaticOptions options{1e-8, 1'000'000, {}};
  std::size_t iterations = 0;
  for (auto _ : run) {
    if constexpr (way == Way::adr)
      iterations = plate::adaptive_dynamic_relaxation(p.op(), constraints, p.load, options).iterations;
    else if constexpr (way == Way::diagonal)
      iterations = plate::conjugate_gradients(p.op(), constraints, p.load, options).iterations;
    else if constexpr (way == Way::local) {
      const plate::ShortHorizonPreconditioner local(p.op(), p.boundary(), c.section, c.discretization);
      iterations = plate::conjugate_gradients(p.op(), constraints, p.load, options, &local).iterations;
    } else if constexpr (way == Way::two_level) {
      const plate::TwoLevelPreconditioner coarse(p.op(), p.boundary(), c.section, c.discretization);
      iterations = plate::conjugate_gradients(p.op(), constraints, p.load, options, &coarse).iterations;
    } else {
      const plate::AssembledPlate factor(p.op(), constraints, plate::stiffness_matrix(p.op(), true));
      iterations = plate::conjugate_gradients(p.op(), constraints, p.load, options, &factor).iterations;
    }
  }
  run.counters["iterations"] = double(iterations);
}

/// One more load, once the preconditioner is there.
template <typename Factorised>
void next_load(benchmark::State& run) {
  omp_set_num_threads(2);
  Plate& p = plate_of(run.range(0));
  const Factorised factor(p.op(), p.boundary(), p.file.content.section, p.file.content.discretization);
  for (auto _ : run) plate::conjugate_gradients(p.op(), p.boundary().constraints, p.load, {1e-8, 1000, {}}, &factor);
}

/// `range(1)` loads on one factorisation of the plate.
void loads_on_one_factor(benchmark::State& run) {
  omp_set_num_threads(2);
  Plate& p = plate_of(run.range(0));
  const std::vector<plate::Forces> loads(std::size_t(run.range(1)), p.load);
  for (auto _ : run) {
    const plate::AssembledPlate factor(p.op(), p.boundary().constraints, plate::stiffness_matrix(p.op(), true));
    benchmark::DoNotOptimize(factor.solve(loads));
  }
}

constexpr auto ms = benchmark::kMillisecond;

BENCHMARK(peak_arithmetic);
BENCHMARK(triad)->Arg(1)->Arg(2)->Unit(ms)->UseRealTime();
BENCHMARK(list_with_geometry_on_the_fly)->Arg(250)->Unit(ms)->UseRealTime();
BENCHMARK(family_list)->Args({250, 1})->Args({250, 2})->Unit(ms)->UseRealTime();
BENCHMARK(lattice_operator)
    ->ArgNames({"cells", "threads"})
    ->Args({250, 1})
    ->Args({250, 2})
    ->Args({100, 2})
    ->Args({500, 2})
    ->Args({1000, 2})
    ->Unit(ms)
    ->UseRealTime();
BENCHMARK(single_precision)->Args({250, 1})->Args({250, 2})->Args({1000, 2})->Unit(ms)->UseRealTime();
BENCHMARK(statics<Way::adr>)->Arg(100)->Arg(250)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(statics<Way::diagonal>)->Arg(100)->Arg(250)->Arg(500)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(statics<Way::local>)->Arg(100)->Arg(250)->Arg(500)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(statics<Way::two_level>)->Arg(100)->Arg(250)->Arg(500)->Arg(1000)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(next_load<plate::ShortHorizonPreconditioner>)->Arg(250)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(next_load<plate::TwoLevelPreconditioner>)->Arg(250)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(statics<Way::direct>)->Arg(100)->Unit(ms)->UseRealTime()->Iterations(1);
BENCHMARK(loads_on_one_factor)->Args({100, 1})->Args({100, 10})->Unit(ms)->UseRealTime()->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
