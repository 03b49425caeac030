use super::*;

#[test]
fn operations_say_how_they_round() {
    let right = "\tadd.rn.f32 %f1, %f2, %f3;\n\t@%p1 mul.rn.f32 %f1, %f2, %f3;\n\
                     \tmad.lo.s32 %r1, %r2, %r3, %r4;\n\tsqrt.rn.f32 %f1, %f2;\n";
    assert_eq!(rounded(right), Ok(()), "as a CPU does it");
    for wrong in [
        "\tadd.f32 %f1, %f2, %f3;",
        "\tfma.rn.f32 %f1, %f2, %f3, %f4;",
        "\t@%p1 mad.f32 %f1, %f2, %f3, %f4;",
        "\tsqrt.approx.f32 %f1, %f2;",
        "\tmul.rn.ftz.f32 %f1, %f2, %f3;",
        "\tadd.rn.f64 %fd1, %fd2, %fd3;",
    ] {
        let fault = rounded(&format!("{right}{wrong}")).expect_err(wrong);
        assert!(fault.contains("kernels.ptx:5:"), "{fault}");
    }
}

#[test]
fn an_older_compiler_is_refused_by_name() {
    let version = |release| format!("rustc 1.x\nrelease: {release}\nLLVM version: 19.1.7\n");
    assert_eq!(is_recent(&version("1.96.0")), Ok(()));
    let fault = is_recent(&version("1.85.0")).expect_err("older");
    assert!(
        fault.contains("Rust 1.85.0") && fault.contains("apt-get update"),
        "{fault}"
    );
}

const REPORT: &str = "\
ptxas info    : Compiling entry function 'light_sample' for 'sm_75'
ptxas info    : Function properties for light_sample
    520 bytes stack frame, 0 bytes spill stores, 0 bytes spill loads
ptxas info    : Used 154 registers, used 0 barriers, 520 bytes cumulative stack size
ptxas info    : Function properties for inner
    0 bytes stack frame, 0 bytes spill stores, 0 bytes spill loads
";

#[test]
fn the_report_of_the_assembler_is_read() {
    let used = usage(REPORT).expect("a report");
    let name = "light_sample".to_owned();
    let expected = Usage {
        name,
        registers: 154,
        stack: 520,
    };
    assert_eq!(used, [expected], "one kernel");
    let spills = REPORT.replacen("0 bytes spill stores", "16 bytes spill stores", 1);
    assert!(
        usage(&spills).expect_err("spills").contains("16 bytes"),
        "says how many"
    );
    let fatal = usage("ptxas fatal: error: no such file").expect_err("nothing");
    assert!(fatal.contains("no such file"), "{fatal}");
}

#[test]
fn committed_kernels_are_made_from_these_sources() {
    assert_eq!(is_current(), Ok(Outcome::Passed));
}

/// Without an assembler: what is committed keeps the rule.
#[test]
fn committed_kernels_are_rounded_as_on_a_cpu() {
    let text = fs::read_to_string(kernels()).expect("kernels");
    assert_eq!(rounded(&text), Ok(()), "kernels.ptx");
    let entries = text.matches(".visible .entry light_").count();
    assert_eq!(entries, 5, "sample, pmf, cut, sample_li, decode");
}

/// The codes of children are bytes: loaded one by one they take most of the time of a GPU.
#[test]
fn committed_kernels_load_children_by_words() {
    let text = fs::read_to_string(kernels()).expect("kernels");
    let loads = |width: &str| {
        text.lines()
            .filter(|l| l.contains(width) && l.contains("\tld."))
            .count()
    };
    let (bytes, words) = (loads("8 \t"), loads("b32 \t"));
    // The children of one node have 192 codes, and each kernel looks at nodes of several receivers.
    assert!(
        bytes < 192 && words > 1000,
        "{bytes} loads of bytes, {words} of words"
    );
}
