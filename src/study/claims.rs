//! The thesis's claims, judged by rows: a number, the range in which it confirms, a verdict.

use super::fit::Line;
use super::results::{Errors, Row};
use super::thesis::{CLUSTERS, ITERATIONS, LINEAR, PATH, STRIDE, TABLE_BOTH, TABLE_VPC, TABLE_VPL};
use super::verdict::{Claim, Criterion, Verdict};

/// All claims, in the thesis's order.
pub fn judge(rows: &[Row]) -> Vec<Claim> {
    vec![
        claim("time is linear in the number of VPLs", linear(rows)),
        claim("little changes after 3–4 iterations of K-means", iterations(rows)),
        claim("a stride of 2 makes clustering 6 times faster", stride(rows)),
        claim("2000 VPL clusters look like 4000 VPLs at half the time", clusters(rows)),
        claim("visibility costs about three times the other terms", visibility(rows)),
        claim("VPLs beat path tracing at equal time", equal_time(rows)),
    ]
}

type Judgement = Option<(Vec<Criterion>, String)>;

fn claim(claim: &'static str, judgement: Judgement) -> Claim {
    let Some((criteria, remark)) = judgement else {
        let remark = "rows are missing".to_owned();
        return Claim { claim, verdict: Verdict::NotMeasured, criteria: Vec::new(), remark };
    };
    let verdict = match criteria.iter().all(Criterion::holds) {
        true => Verdict::Confirmed,
        false => Verdict::Refuted,
    };
    Claim { claim, verdict, criteria, remark }
}

fn linear(rows: &[Row]) -> Judgement {
    let points: Vec<_> = of(rows, LINEAR).map(|row| [row.vpls as f64, row.render.mean]).collect();
    let Line { slope, intercept, r2 } = Line::fit(&points)?;
    let most = points.iter().map(|point| point[1]).fold(0.0, f64::max);
    let remark = format!(
        "rT = {:.3} ms a VPL {} {:.3} s over {} numbers of VPLs; the offset is {:.1} % of the \
         largest rT",
        1e3 * slope,
        if intercept < 0.0 { "−" } else { "+" },
        intercept.abs(),
        points.len(),
        100.0 * intercept.abs() / most,
    );
    Some((vec![Criterion::new("R² of a straight line", r2, 0.99..=f64::INFINITY)], remark))
}

fn iterations(rows: &[Row]) -> Judgement {
    let errors: Vec<_> =
        of(rows, ITERATIONS).filter_map(|row| Some(error(row)?.nrmse.mean)).collect();
    let (first, fourth, last) = (*errors.first()?, *errors.get(3)?, *errors.last()?);
    let largest = errors[3..].iter().map(|error| (error / last - 1.0).abs()).fold(0.0, f64::max);
    let what = "largest change of nRMSE from 4 iterations on, relative to the last";
    let remark = format!(
        "nRMSE {} after 1, {} after 4, {} after {} iterations",
        percent(first),
        percent(fourth),
        percent(last),
        errors.len(),
    );
    Some((vec![Criterion::new(what, largest, 0.0..=0.05)], remark))
}

fn stride(rows: &[Row]) -> Judgement {
    let rows: Vec<_> = of(rows, STRIDE).collect();
    let seconds = |index: usize| Some(rows.get(index)?.phases.cluster_points);
    let error = |index: usize| Some(error(rows.get(index)?)?.nrmse.mean);
    let ratio = seconds(0)? / seconds(1)?;
    let remark = format!(
        "strides 4 and 8 are {:.2} and {:.2} times faster; nRMSE {} at stride 1, then {}, {}, \
         {}. All of the 4 iterations but the last, which sees all points, see one in a stride: a \
         stride of 2 leaves 2.5 of 4 assignments, which is at most 1.6 times faster",
        seconds(0)? / seconds(2)?,
        seconds(0)? / seconds(3)?,
        percent(error(0)?),
        percent(error(1)?),
        percent(error(2)?),
        percent(error(3)?),
    );
    Some((vec![Criterion::new("times faster at stride 2", ratio, 5.0..=f64::INFINITY)], remark))
}

fn clusters(rows: &[Row]) -> Judgement {
    let mut found = of(rows, CLUSTERS);
    let (mean, member) = (found.next()?, found.next()?);
    let (merged, clusters) = (error(mean)?, mean.vpl_clusters?);
    let remark = format!(
        "{} VPLs in {clusters} clusters: were time linear in lights, tT would be {:.3}; bias {}; \
         with a member in the place of the mean, nRMSE {}",
        mean.vpls,
        clusters as f64 / mean.vpls as f64,
        percent(merged.bias.mean),
        percent(error(member)?.nrmse.mean),
    );
    let time = 1.0 / mean.speedup?;
    let criteria = vec![
        Criterion::new("nRMSE against all VPLs", merged.nrmse.mean, 0.0..=0.02),
        Criterion::new("tT relative to all VPLs", time, 0.0..=0.6),
    ];
    Some((criteria, remark))
}

fn visibility(rows: &[Row]) -> Judgement {
    let vpl = of(rows, TABLE_VPL).last()?;
    let find = |points| of(rows, TABLE_VPC).find(|row| row.wanted_point_clusters == Some(points));
    let show = |row: &Row| {
        let phases = &row.phases;
        format!("{:.3} s of visibility and {:.3} s of shading", phases.visibility, phases.shading)
    };
    let phases = &vpl.phases;
    let remark = format!(
        "`vpl` takes {}; `vpc` takes {} with 100 clusters (thesis: 0.055 s and 49.203 s), {} \
         with 8000 (thesis: 4.559 s and 50.323 s)",
        show(vpl),
        show(find(100)?),
        show(find(8000)?),
    );
    let ratio = phases.visibility / phases.shading;
    let what = "visibility over shading, `vpl` 2000 × 2";
    Some((vec![Criterion::new(what, ratio, 2.0..=4.0)], remark))
}

fn equal_time(rows: &[Row]) -> Judgement {
    let both = of(rows, TABLE_BOTH).next()?;
    let seconds = both.seconds.mean;
    let paths: Vec<_> =
        of(rows, PATH).filter_map(|row| Some([row.seconds.mean.ln(), relmse(row)?.ln()])).collect();
    // A path tracer's error is a power of its time.
    let Line { slope, intercept, .. } = Line::fit(&paths)?;
    let path = (intercept + slope * seconds.ln()).exp();
    let own = relmse(both)?;
    let remark = format!(
        "relMSE against a converged path tracer, whole image: `both` {own:.1e} in {seconds:.2} s; \
         `path`, by a line through its rows, {path:.1e} in that time"
    );
    let what = "relMSE of `path` over that of `both` at its time";
    Some((vec![Criterion::new(what, path / own, 1.0..=f64::INFINITY)], remark))
}

fn of<'a>(rows: &'a [Row], experiment: &'static str) -> impl Iterator<Item = &'a Row> {
    rows.iter().filter(move |row| row.experiment == experiment)
}

fn relmse(row: &Row) -> Option<f64> {
    Some(row.total.as_ref()?.relmse.mean)
}

fn error(row: &Row) -> Option<&Errors> {
    row.clustering.as_ref()
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_criterion_decides() {
        let verdict = |value| {
            let criteria = vec![Criterion::new("x", value, 2.0..=4.0)];
            claim("c", Some((criteria, String::new()))).verdict
        };
        assert_eq!(verdict(3.0), Verdict::Confirmed);
        assert_eq!(verdict(1.9), Verdict::Refuted);
        assert_eq!(verdict(4.1), Verdict::Refuted);
        assert_eq!(verdict(f64::NAN), Verdict::Refuted);
        assert_eq!(claim("c", None).verdict, Verdict::NotMeasured);
    }
}
