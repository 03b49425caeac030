/// The workspace of the kernels.
pub(super) const WORKSPACE: &str = "gpu/ptx";

/// The oldest architecture that the kernels run on.
pub(super) const TARGET_CPU: &str = "sm_75";

/// The options of their compiler.
pub(super) fn rust_flags() -> String {
    format!("-Ctarget-cpu={TARGET_CPU} -Zunstable-options -Cpanic=immediate-abort")
}
