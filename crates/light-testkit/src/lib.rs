//! light-testkit
