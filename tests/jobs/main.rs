//! What keeps jobs, held to every promise: in a file, in memory and in PostgreSQL, and against a model.
//!
//! The part over PostgreSQL runs where `TEST_POSTGRES_URL` names a database in which schemas may be made;
//! `tests/with-postgres` makes one for the time of a command.

#![expect(clippy::unwrap_used, reason = "what fails here fails the test")]

mod addresses;
mod callbacks;
mod ends;
mod hints;
mod home;
mod keys;
mod leases;
mod lives;
mod model;
mod order;
mod postgres;
mod random;
mod timeouts;
mod together;

use home::Home;

/// Each of these tests over each kind of store.
macro_rules! over_every_store {
    ($($file:ident::$test:ident)*) => {
        mod in_a_file {
            $(#[tokio::test] async fn $test() { crate::$file::$test(&crate::Home::in_a_file()).await; })*
        }
        mod in_memory {
            $(#[tokio::test] async fn $test() { crate::$file::$test(&crate::Home::in_memory().await).await; })*
        }
        mod in_postgres {
            $(#[tokio::test] async fn $test() {
                if let Some(home) = crate::Home::in_postgres().await {
                    crate::$file::$test(&home).await;
                    home.remove().await;
                }
            })*
        }
    };
}

/// Each of these tests over each kind of store that others can write to as well.
macro_rules! over_every_shared_store {
    ($($file:ident::$test:ident)*) => {
        mod in_a_shared_file {
            $(#[tokio::test] async fn $test() { crate::$file::$test(&crate::Home::in_a_file()).await; })*
        }
        mod in_a_shared_postgres {
            $(#[tokio::test] async fn $test() {
                if let Some(home) = crate::Home::in_postgres().await {
                    crate::$file::$test(&home).await;
                    home.remove().await;
                }
            })*
        }
    };
}

over_every_shared_store! {
    timeouts::a_call_that_timed_out_has_changed_nothing
    timeouts::a_lease_begins_when_the_store_can_write
}

over_every_store! {
    lives::a_job_is_queued_runs_and_succeeds
    lives::a_failure_keeps_its_problem
    lives::nobody_sees_anothers_jobs
    lives::any_text_and_a_long_body_come_back_as_they_were
    lives::the_best_so_far_never_gets_worse
    lives::events_of_incumbents_end_at_a_hundred
    lives::a_store_answers_and_counts
    ends::a_queued_job_is_cancelled_at_once
    ends::a_running_job_is_cancelled_with_its_answer
    ends::a_cancelled_job_that_fails_has_no_answer
    ends::what_has_ended_is_not_cancelled
    ends::only_ended_jobs_are_deleted
    ends::a_job_that_waited_too_long_expires
    ends::a_job_that_begins_in_time_may_take_longer
    ends::what_ended_is_forgotten_when_its_time_is_over
    ends::a_sweep_sees_to_more_than_one_batch
    leases::a_worker_that_renews_keeps_its_job
    leases::a_lost_worker_has_no_say_any_more
    leases::an_end_is_kept_once_and_may_be_told_twice
    leases::a_job_that_is_handed_back_was_never_claimed
    leases::a_cancelled_job_that_is_handed_back_is_cancelled
    leases::the_third_lost_worker_ends_a_job
    leases::a_cancelled_job_ends_with_its_worker
    leases::a_fence_grows_with_each_claim
    order::priorities_go_first_and_then_the_earliest
    order::owners_alternate_whatever_each_has_queued
    order::who_comes_late_is_owed_no_turns
    order::a_jobs_position_is_when_it_is_claimed
    order::a_list_goes_page_by_page_from_the_latest
    keys::a_known_key_gives_the_same_jobs
    keys::a_key_belongs_to_one_request_of_one_owner
    keys::a_forgotten_job_frees_its_key
    keys::a_request_is_accepted_as_a_whole_or_not_at_all
    keys::a_known_key_is_answered_by_a_full_queue
    keys::a_claimed_job_leaves_its_place_in_the_queue
    together::one_key_at_once_gives_one_job
    together::claims_at_once_get_each_job_once
    together::the_queue_is_never_overfilled
    together::sweeps_at_once_share_the_work
    together::of_two_ends_at_once_one_counts
    callbacks::a_callback_is_due_at_the_end
    callbacks::a_callback_is_tried_until_it_is_over
    callbacks::an_older_try_has_no_say
    callbacks::every_kind_of_end_is_called_back
    callbacks::callbacks_at_once_are_taken_once
    timeouts::a_claim_whose_caller_left_is_handed_back
    timeouts::a_callback_whose_caller_left_is_due_at_once
    hints::what_waits_for_a_worker_wakes_workers
    hints::a_change_wakes_who_waits_for_it
}

#[test]
fn the_part_over_postgres_runs_or_says_that_it_does_not() {
    use std::io::Write;

    if home::postgres_url().is_none() {
        // Past the test runner, which keeps to itself what is printed in tests that pass.
        writeln!(std::io::stderr(), "not run: jobs in PostgreSQL; see tests/with-postgres").unwrap();
    }
}
