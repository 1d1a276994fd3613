//! The code that the benches of all stages share: ids, throughput, and the share of the floor.

use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput};
use texere_bench::{median, stream};

/// The most bytes that a fill writes. Beyond the size of the caches its time grows in proportion to
/// the bytes, so larger fills are extrapolated.
const FILL: u64 = 1 << 30;

/// The number of samples of a benchmark: the fewest that criterion allows, because a large mesh
/// takes long.
const SAMPLES: usize = 10;

/// A benchmark, `stage/fabric/size/backend`, and the elements and bytes that one run of it makes.
pub(crate) struct Bench<'a> {
    pub(crate) stage: &'a str,
    pub(crate) fabric: &'a str,
    /// The numbers of ends and picks.
    pub(crate) size: (usize, usize),
    pub(crate) backend: &'a str,
    pub(crate) elements: u64,
    pub(crate) bytes: u64,
}

/// Memory for the plain fill that is the floor of every stage.
pub(crate) struct Floor(Vec<f32>);

impl Floor {
    pub(crate) fn new() -> Self {
        Self(vec![1.0; FILL as usize / 4])
    }

    /// The time of writing `bytes` on all cores, in seconds.
    fn seconds(&mut self, bytes: u64) -> f64 {
        let filled = bytes.min(FILL);
        let start = Instant::now();
        stream::fill(&mut self.0[..filled as usize / 4], 2.0);
        start.elapsed().as_secs_f64() * bytes as f64 / filled as f64
    }

    /// Measures `work`, which returns its own time, beside a fill of as many bytes. Prints the
    /// work's share of the fill's bandwidth: the median over the samples, each of which has a fill
    /// of its own.
    pub(crate) fn bench(
        &mut self,
        criterion: &mut Criterion,
        bench: &Bench<'_>,
        mut work: impl FnMut() -> Duration,
    ) {
        let (ends, picks) = bench.size;
        let mut shares = Vec::new();
        let mut group = criterion.benchmark_group(format!("{}/{}", bench.stage, bench.fabric));
        group.sample_size(SAMPLES).sampling_mode(SamplingMode::Flat);
        group.warm_up_time(Duration::from_millis(100)).measurement_time(Duration::from_millis(500));
        group.throughput(Throughput::ElementsAndBytes { elements: bench.elements, bytes: bench.bytes });
        group.bench_function(BenchmarkId::new(format!("{ends}x{picks}"), bench.backend), |bencher| {
            bencher.iter_custom(|runs| {
                let fill = self.seconds(bench.bytes);
                let time: Duration = (0..runs).map(|_| work()).sum();
                shares.push(fill * runs as f64 / time.as_secs_f64());
                time
            });
        });
        group.finish();
        if !shares.is_empty() {
            println!("{:24}share: {:.0} % of a plain fill on all cores", "", 100.0 * median(shares));
        }
    }
}

/// The time of `work`. The value that it returns is dropped after the time is taken.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    let _made = work();
    start.elapsed()
}
