//! `trace.json`: the stages of chosen frames in the trace event format of Chrome, which Perfetto reads too.

use crate::measure::{FrameTrace, StageSpan};
use serde_json::{Value, json};
use std::io::{self, Write};

/// A track each: (process, its name, its one thread's name).
const CPU: (u32, &str, &str) = (1, "CPU", "recording of commands");
const GPU: (u32, &str, &str) = (2, "GPU", "queue");

/// Writes complete events (`ph` X), parents before children, times in microseconds. The tracks' clocks are
/// not one: see [`StageSpan`].
pub(super) fn write_trace(mut out: impl Write, frames: &[FrameTrace]) -> io::Result<()> {
    writeln!(out, "{{\"displayTimeUnit\":\"ms\",\"traceEvents\":[")?;
    let names = [CPU, GPU].into_iter().flat_map(track_names);
    let stages = frames.iter().flat_map(|frame| frame.stages.iter().map(move |stage| (frame, stage)));
    let events = stages.flat_map(|(frame, stage)| {
        let cpu = Some(event(CPU.0, frame, stage, stage.cpu_ns));
        let gpu = stage.gpu_ns.map(|span| event(GPU.0, frame, stage, span));
        cpu.into_iter().chain(gpu)
    });
    for (number, event) in names.chain(events).enumerate() {
        let comma = if number == 0 { "" } else { ",\n" };
        write!(out, "{comma}{event}")?;
    }
    writeln!(out, "\n]}}")
}

fn track_names((process, name, thread): (u32, &str, &str)) -> [Value; 3] {
    let metadata =
        |kind: &str, args: Value| json!({ "ph": "M", "name": kind, "pid": process, "tid": 1, "args": args });
    [
        metadata("process_name", json!({ "name": name })),
        metadata("process_sort_index", json!({ "sort_index": process })),
        metadata("thread_name", json!({ "name": thread })),
    ]
}

fn event(process: u32, frame: &FrameTrace, stage: &StageSpan, [start, end]: [u64; 2]) -> Value {
    let microseconds = |ns: u64| ns as f64 / 1e3;
    let name = stage.stage.rsplit('/').next().unwrap_or(&stage.stage);
    json!({
        "ph": "X", "name": name, "cat": "stage", "pid": process, "tid": 1,
        "ts": microseconds(start), "dur": microseconds(end.saturating_sub(start)),
        "args": { "frame": frame.frame, "run": frame.run, "stage": stage.stage },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trace_names_its_tracks_and_has_an_event_a_stage_and_clock() {
        let span = |stage: &str, gpu_ns, cpu_ns| StageSpan { stage: stage.into(), gpu_ns, cpu_ns };
        let stages =
            vec![span("frame", Some([5000, 9500]), [0, 5000]), span("frame/shade[0]", None, [1000, 2001])];
        let mut text = vec![];
        write_trace(&mut text, &[FrameTrace { run: 1, frame: 300, stages }]).unwrap();
        let trace: Value = serde_json::from_slice(&text).unwrap();
        let events = trace["traceEvents"].as_array().unwrap();
        let names = events.iter().filter(|event| event["name"] == "process_name");
        let names: Vec<&str> = names.map(|event| event["args"]["name"].as_str().unwrap()).collect();
        assert_eq!(names, ["CPU", "GPU"]);
        let stages: Vec<&Value> = events.iter().filter(|event| event["ph"] == "X").collect();
        assert_eq!(stages.len(), 3);
        assert_eq!(
            (&stages[1]["pid"], &stages[1]["ts"], &stages[1]["dur"]),
            (&json!(2), &json!(5.0), &json!(4.5))
        );
        assert_eq!((&stages[2]["name"], &stages[2]["dur"]), (&json!("shade[0]"), &json!(1.001)));
        assert_eq!(stages[2]["args"], json!({ "frame": 300, "run": 1, "stage": "frame/shade[0]" }));
    }

    #[test]
    fn no_frames_are_a_trace_too() {
        let mut text = vec![];
        write_trace(&mut text, &[]).unwrap();
        assert!(serde_json::from_slice::<Value>(&text).is_ok());
    }
}
