//! Arguments and their conversion to jobs.
