//! Usage errors, in the same one-line form as all others.

use super::{UNREAD, console};
use clap::error::ErrorKind;
use std::ffi::OsString;
use std::io;
use std::process::ExitCode;

/// Prints what clap has to say (help and version on standard output, else one line) and gives the exit code.
pub fn exit(error: &clap::Error) -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    let json = arguments.iter().any(|argument| argument == "--json");
    let refuse = |message: &str| {
        console::print_error(message, "input", 2, json);
        ExitCode::from(2)
    };
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            match console::print(&error.render().to_string()) {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::from(UNREAD),
                Err(error) => refuse(&console::not_printed(&error).to_string()),
            }
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            console::complain(error.render().to_string().trim_end());
            ExitCode::from(2)
        }
        ErrorKind::InvalidUtf8 => refuse(&not_utf8(&arguments)),
        _ => refuse(&one_line(&error.render().to_string())),
    }
}

/// clap does not say which argument it cannot read.
fn not_utf8(arguments: &[OsString]) -> String {
    let named: Vec<String> = arguments
        .iter()
        .filter(|argument| argument.to_str().is_none())
        .map(|argument| format!("{argument:?}"))
        .collect();
    format!("{} is not UTF-8 text: rename the file", named.join(" and "))
}

/// Folds clap's message to one line: its tips stay, the usage summary goes.
fn one_line(rendered: &str) -> String {
    let text = rendered.strip_prefix("error: ").unwrap_or(rendered);
    let mut line = String::new();
    for part in text.lines().map(str::trim).filter(|part| !part.is_empty()) {
        if part.starts_with("Usage:") || part.starts_with("For more information") {
            break;
        }
        if !line.is_empty() {
            line.push_str(if line.ends_with(':') { " " } else { "; " });
        }
        line.push_str(part.strip_prefix("tip: ").unwrap_or(part));
    }
    line
}

#[cfg(test)]
mod tests {
    use super::super::Cli;
    use super::one_line;
    use clap::Parser;

    fn message(arguments: &[&str]) -> String {
        let error = Cli::try_parse_from(arguments.iter().copied()).unwrap_err();
        one_line(&error.render().to_string())
    }

    #[test]
    fn usage_errors_are_one_line_with_the_cause_and_the_nearest_name() {
        assert_eq!(
            message(&["manylight", "replay", "--msaa", "3"]),
            "invalid value '3' for '--msaa <1|4>': 3 samples a pixel: only 1 or 4"
        );
        let line = message(&["manylight", "replay", "--mssa", "4"]);
        assert!(line.contains("'--mssa'") && line.contains("'--msaa'") && !line.contains('\n'), "{line}");
        assert_eq!(
            message(&["manylight", "scene"]),
            "the following required arguments were not provided: <NAME|PATH>"
        );
        let line = message(&["manylight", "replay", "--marking", "deph"]);
        assert!(line.contains("[possible values: depth, geometry]") && line.contains("'depth'"), "{line}");
    }
}
